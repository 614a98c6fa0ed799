// Values that several subcommands take: points and sizes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace jalousie::app {

/// "1,2.5,-3"; absent if it is anything else or not finite.
std::optional<glm::dvec3> parsePoint(std::string_view text);

/// An option that takes X,Y,Z. target must outlive the parse.
void addPoint(CLI::App& command, const char* name, std::optional<glm::dvec3>& target, const char* help);

/// --size WxH, up to 16384 a side. width and height must outlive the parse.
void addSize(CLI::App& command, std::uint32_t& width, std::uint32_t& height);

/// What stands between separators; one empty text for an empty one.
std::vector<std::string> split(const std::string& text, char separator);

/// An argument as a shell wants it: in single quotes where it holds anything but plain characters.
std::string shellQuoted(std::string_view argument);

}  // namespace jalousie::app
