// A name counts before a number.
#include "app/path_camera.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/option_checks.h"
#include "core/error.h"

namespace jalousie::app {

void addCameraOption(CLI::App& command, std::string& which) {
  command.add_option("--camera", which, "Follow the camera with this name or number [0]")->type_name("NAME|NUMBER");
}

void addTimeOption(CLI::App& command, std::optional<double>& seconds) {
  command
      .add_option("--time", seconds,
                  "Show nodes, skins and morph targets at this time of their animations, whatever the frame; a path is "
                  "then as long as its camera; seconds [they follow the frame; without one, the pose without them]")
      ->check(cli::inRange(0.0, 1e6).description(""))
      ->type_name("SECONDS");
}

std::vector<asset::Camera> chosenFirst(std::vector<asset::Camera> cameras, const std::string& which,
                                       const std::filesystem::path& file) {
  if (which.empty()) return cameras;
  std::size_t chosen = 0;
  while (chosen < cameras.size() && cameras[chosen].name != which)
    ++chosen;
  for (std::size_t i = 0; i < cameras.size() && chosen == cameras.size(); ++i)
    if (which == std::to_string(i)) chosen = i;
  if (chosen < cameras.size()) {
    std::rotate(cameras.begin(), cameras.begin() + static_cast<std::ptrdiff_t>(chosen),
                cameras.begin() + static_cast<std::ptrdiff_t>(chosen) + 1);
    return cameras;
  }
  std::string names;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    names += fmt::format("{}{} {}", i > 0 ? ", " : "", i, cameras[i].name);
  throw Error(ErrorCode::kUsage,
              fmt::format("has no camera \"{}\"; {}", which,
                          cameras.empty() ? "it has none at all" : "its cameras are " + names),
              file);
}

}  // namespace jalousie::app
