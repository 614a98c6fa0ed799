// Options of `jalousie view`: those of a picture, and those of the window.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/render_options.h"

namespace CLI {
class App;
}

namespace jalousie::app {

struct ViewOptions {
  std::vector<std::filesystem::path> files;  ///< files and folders; may be empty
  RenderOptions render;                      ///< options of the picture at the start; its size is that of the window
  std::optional<std::string> split;          ///< options of configuration B; absent: no split screen
  float divider = 0.5F;                      ///< left edge of configuration B, share of the width
  std::filesystem::path screenshot;          ///< empty: none
  std::optional<std::uint32_t> frames;       ///< number of frames of a script; absent: runs until the window is closed
  bool withInterface = false;                ///< the screenshot shows the interface
  std::filesystem::path json;                ///< file for the statistics of the last frames; empty: none
  std::optional<std::uint32_t> select;       ///< instance to inspect, index in the file
  bool list = false;                         ///< the list of objects is open
  bool watch = false;
  bool play = false;
  std::filesystem::path shaders;  ///< folder of the shaders; empty: those built into the program
  std::filesystem::path outputs;  ///< folder of screenshots and paths; empty: the current folder
  float scale = 0.0F;             ///< of the interface; 0: that of the display
  bool debug = false;             ///< debug context; its warnings and errors make the program fail

  bool sizeGiven = false;  ///< --size was given; otherwise the window has its last size

  /// Fills in dependent values and refuses contradictions. Errors: kUsage.
  void finish();
};

/// Declares the options on a subcommand; values land in options, which must outlive the parse.
void addViewOptions(CLI::App& command, ViewOptions& options);

/// Parses the value of --split. Errors: kUsage.
RenderOptions viewOptionsOf(const std::string& text);

/// Replaces each folder by the glTF and GLB files in it, sorted by name. A folder without such files stays, so that
/// opening it fails with a message.
std::vector<std::filesystem::path> expandFolders(const std::vector<std::filesystem::path>& arguments);

}  // namespace jalousie::app
