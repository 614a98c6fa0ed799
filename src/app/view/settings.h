// What the viewer remembers between runs: of the interface only, so that a picture depends on the command line alone.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/view/pose.h"

namespace jalousie::app {

inline constexpr std::size_t kBookmarks = 9;
using Bookmarks = std::array<std::optional<Pose>, kBookmarks>;

inline constexpr float kLeastSpeed = 0.01F;
inline constexpr float kMostSpeed = 100.0F;

struct ViewSettings {
  bool panel = true;
  bool graph = false;
  float speed = 1.0F;          ///< of flying; 1: a tenth of the scene's diagonal a second
  std::uint32_t width = 1280;  ///< of the window, screen coordinates
  std::uint32_t height = 720;
  std::string layout;                          ///< the interface library's own text
  std::map<std::string, Bookmarks> bookmarks;  ///< by absolute path of the file
};

/// $XDG_CONFIG_HOME/jalousie, else ~/.config/jalousie; empty if there is no home.
std::filesystem::path settingsFolder();

/// What is missing or broken there has its default. Never throws.
ViewSettings loadSettings(const std::filesystem::path& folder) noexcept;

/// Makes the folder. Errors: kWriteFailed.
void saveSettings(const ViewSettings& settings, const std::filesystem::path& folder);

}  // namespace jalousie::app
