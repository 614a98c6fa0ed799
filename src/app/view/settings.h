// Settings of the interface that are kept between runs. Options of the picture are not kept, so that a picture depends
// on the command line alone.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/view/pose.h"

namespace jalousie::app {

inline constexpr std::size_t kBookmarks = 9;
using Bookmarks = std::array<std::optional<WorldPose>, kBookmarks>;

inline constexpr float kLeastSpeed = 0.01F;
inline constexpr float kMostSpeed = 100.0F;

inline constexpr std::size_t kMostRecent = 10;

struct ViewSettings {
  bool panel = true;
  bool graph = false;
  bool objects = false;        ///< the list of objects
  float speed = 1.0F;          ///< of flying; 1: 10 % of the scene's diagonal per second
  std::uint32_t width = 1280;  ///< of the window, screen coordinates
  std::uint32_t height = 720;
  std::string layout;                          ///< Interface::layout()
  std::vector<std::string> recent;             ///< absolute paths of files, the newest first; at most kMostRecent
  std::map<std::string, Bookmarks> bookmarks;  ///< by absolute path of the file
};

/// $XDG_CONFIG_HOME/jalousie, else ~/.config/jalousie; empty if neither variable is set.
std::filesystem::path settingsFolder();

/// Reads view.json of a folder. Untrusted input: entries that are missing or invalid get their defaults.
ViewSettings loadSettings(const std::filesystem::path& folder) noexcept;

/// Puts a file at the start of the recent ones.
void addRecent(ViewSettings& settings, const std::string& file);

/// Adds bookmarks of other settings where there are none.
void mergeBookmarks(ViewSettings& settings, const ViewSettings& others);

/// Writes the settings; creates the folder. Errors: kWriteFailed.
void saveSettings(const ViewSettings& settings, const std::filesystem::path& folder);

}  // namespace jalousie::app
