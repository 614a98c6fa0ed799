// Which camera of a file counts, and the time of its animations.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asset/scene_types.h"

namespace CLI {
class App;
}

namespace jalousie::app {

/// Declares --camera on a command; which must outlive the parse.
void addCameraOption(CLI::App& command, std::string& which);

/// Declares --time on a command; seconds must outlive the parse.
void addTimeOption(CLI::App& command, std::optional<double>& seconds);

/// The cameras of a file, the chosen one first. @param which  its name or number; empty: the first one
/// Errors: kUsage if there is no such camera.
std::vector<asset::Camera> chosenFirst(std::vector<asset::Camera> cameras, const std::string& which,
                                       const std::filesystem::path& file);

}  // namespace jalousie::app
