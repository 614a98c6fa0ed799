// Parsing with CLI11's own conversion of numbers.
#include "app/option_values.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

namespace jalousie::app {
namespace {

constexpr std::uint32_t kMostPixelsASide = 16384;

bool parseSize(const std::string& text, std::uint32_t& width, std::uint32_t& height) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return false;
  return CLI::detail::lexical_cast(text.substr(0, cross), width) &&
         CLI::detail::lexical_cast(text.substr(cross + 1), height) && width >= 1 && height >= 1 &&
         width <= kMostPixelsASide && height <= kMostPixelsASide;
}

}  // namespace

std::optional<glm::dvec3> parsePoint(std::string_view text) {
  glm::dvec3 point(0.0);
  for (glm::length_t k = 0; k < 3; ++k) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (k == 2)) return std::nullopt;
    if (!CLI::detail::lexical_cast(std::string(text.substr(0, comma)), point[k]) ||
        !std::isfinite(static_cast<float>(point[k])))
      return std::nullopt;
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return point;
}

void addPoint(CLI::App& command, const char* name, std::optional<glm::dvec3>& target, const char* help) {
  command
      .add_option(
          name,
          [&target](const CLI::results_t& results) {
            target = parsePoint(results.at(0));
            return target.has_value();
          },
          help)
      ->type_name("X,Y,Z");
}

void addSize(CLI::App& command, std::uint32_t& width, std::uint32_t& height) {
  command
      .add_option(
          "--size",
          [&width, &height](const CLI::results_t& results) { return parseSize(results.at(0), width, height); },
          "Image size in pixels, up to 16384 a side [1280x720]")
      ->type_name("WxH");
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(separator, from), text.size());
    parts.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return parts;
}

std::string shellQuoted(std::string_view argument) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string_view::npos) return std::string(argument);
  std::string quoted = "'";
  for (const char c : argument) {
    if (c == '\'')
      quoted += "'\\''";
    else
      quoted += c;
  }
  quoted += '\'';
  return quoted;
}

}  // namespace jalousie::app
