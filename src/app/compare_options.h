// Options of `jalousie compare`: what the command line says, checked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/configurations.h"
#include "compare/experiment.h"

namespace CLI {
class App;
}

namespace jalousie::app {

struct CompareOptions {
  std::filesystem::path scene;
  std::filesystem::path path;  ///< glTF with the camera path; empty: the scene's own
  std::string camera;          ///< its name or number; empty: the first one
  std::filesystem::path output;
  std::string json;  ///< empty: none; "-": summary.json to standard output as well
  std::string configurations = "standard";
  std::vector<std::string> moreConfigurations;  ///< NAME=OPTIONS
  std::string baseline;                         ///< empty: the first configuration
  std::string frames;                           ///< A:B:STEP; empty: the whole path, at most kDefaultFrames of it
  std::string sweep;                            ///< tau=A:B or tau=A,B,C; empty: none
  std::string reference = "lod0";
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  std::uint32_t keep = 6;
  std::uint32_t lead = 8;
  double pixelsPerDegree = compare::kDefaultPixelsPerDegree;
  bool resume = false;
  bool quiet = false;
  bool debug = false;   ///< an OpenGL debug context, whose messages become the exit code
  std::string command;  ///< to repeat it, for the report

  std::vector<ConfigurationText> chosen;  ///< filled by finish()
  std::vector<float> taus;                ///< likewise

  /// Refuses contradictions before anything is loaded. Errors: kUsage, and as chosenConfigurations().
  void finish();
};

/// Frames that are measured where nothing is said.
inline constexpr std::uint32_t kDefaultFrames = 60;

/// Declares the options on a subcommand; values land in options, which must outlive the parse.
void addCompareOptions(CLI::App& command, CompareOptions& options);

/// "A:B:STEP", "A:B" or "A". @param frameCount  of the path. Errors: kUsage.
compare::FrameRange parseFrames(const std::string& text, std::uint32_t frameCount);

/// "tau=0.25:8" (doubling from one to the other) or "tau=0.5,1,2". Errors: kUsage.
std::vector<float> parseSweep(const std::string& text);

}  // namespace jalousie::app
