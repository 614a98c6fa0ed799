// Options of `jalousie compare`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/configurations.h"
#include "compare/plan.h"
#include "core/memory_limit.h"
#include "core/output_files.h"

namespace CLI {
class App;
}

namespace jalousie::app {

struct CompareOptions {
  std::filesystem::path scene;
  std::filesystem::path path;  ///< glTF with the camera path; empty: the scene's own
  std::optional<double> time;  ///< of the scene's animations, seconds; absent: the pose without them
  std::string camera;          ///< its name or number; empty: the first one
  std::filesystem::path output;
  std::string json;  ///< "-": print summary.json on standard output as well; empty: do not
  std::string configurations = "standard";
  std::vector<std::string> moreConfigurations;  ///< NAME=OPTIONS
  std::string baseline;                         ///< empty: the first configuration
  std::string frames;                           ///< A:B:STEP; empty: at most kDefaultFrames of the whole path
  std::string sweep;                            ///< tau=A:B or tau=A,B,C; empty: none
  std::string reference = "lod0";
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  std::uint32_t keep = 6;
  std::uint32_t lead = 8;
  std::uint32_t objects = 100;
  double pixelsPerDegree = compare::kDefaultPixelsPerDegree;
  bool butteraugli = false;
  MemoryLimit memory{kDefaultMaxMemory, "--max-memory"};
  Replace replace = Replace::kSameKind;
  bool resume = false;
  bool quiet = false;
  bool debug = false;   ///< use an OpenGL debug context; its messages set the exit code
  std::string command;  ///< shown in the report, so that the experiment can be repeated

  std::vector<ConfigurationText> chosen;  ///< set by finish()
  std::vector<float> taus;                ///< likewise

  /// Parses and checks the options before anything is loaded. Errors: kUsage, kLimit, as chosenConfigurations().
  void finish();
};

/// Most frames that are measured without --frames.
inline constexpr std::uint32_t kDefaultFrames = 60;

/// Declares the options on a subcommand; values land in options, which must outlive the parse.
void addCompareOptions(CLI::App& command, CompareOptions& options);

/// "A:B:STEP", "A:B" or "A". @param frameCount  of the path. Errors: kUsage.
compare::FrameRange parseFrames(const std::string& text, std::uint32_t frameCount);

/// "tau=A:B" gives A, 2A, 4A, ... up to B; "tau=0.5,1,2" lists the values. @return  ascending, without repeats, pixels
/// Errors: kUsage.
std::vector<float> parseSweep(const std::string& text);

}  // namespace jalousie::app
