// Options of `jalousie view`: those of a picture, and what only a window has.
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
  RenderOptions render;                      ///< the state at the start; its size is the window's
  std::optional<std::string> split;          ///< options of the right half
  float divider = 0.5F;                      ///< its left edge, share of the width
  std::filesystem::path screenshot;          ///< empty: none
  std::optional<std::uint32_t> frames;       ///< leave after so many; absent: when the window is closed
  bool withInterface = false;                ///< in the screenshot
  std::filesystem::path json;                ///< figures of the last frames; empty: none
  std::optional<std::uint32_t> select;       ///< object to inspect, in the file's order
  bool watch = false;
  bool play = false;
  std::filesystem::path shaders;  ///< folder to read shaders from; empty: the embedded ones
  std::filesystem::path outputs;  ///< folder of screenshots and paths; empty: the current one
  float scale = 0.0F;             ///< of the interface; 0: the display's
  bool debug = false;             ///< an OpenGL debug context, whose messages become the exit code

  bool sizeGiven = false;  ///< --size was said; else the window is as large as it was last

  /// Refuses contradictions. Errors: kUsage.
  void finish();
};

/// Declares the options on a subcommand; values land in options, which must outlive the parse.
void addViewOptions(CLI::App& command, ViewOptions& options);

/// The options of a second configuration, as --split takes them. Errors: kUsage.
RenderOptions viewOptionsOf(const std::string& text);

/// The files that arguments name: a folder stands for the glTF and GLB files in it, in order of their names.
/// A folder without any stands for itself, and fails where it is opened.
std::vector<std::filesystem::path> expandFolders(const std::vector<std::filesystem::path>& arguments);

}  // namespace jalousie::app
