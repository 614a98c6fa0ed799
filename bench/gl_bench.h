// The frame of a benchmark that uses OpenGL: command line, context, head, JSON file, exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/output_files.h"

namespace jalousie::render {
struct FrameStatistics;
}

namespace jalousie::bench {

/// Exit code if a benchmark measured a wrong result. Its figures are then not written.
inline constexpr int kWrongResult = 1;

/// Ends the benchmark with kWrongResult and a message if `right` is false.
void require(bool right, const std::string& message);

/// Requires that the counts of a frame agree: every object is drawn or culled (or, with cells, all of its
/// cells are), and every drawn object has a level.
/// @param where  names the frame in the message
void requireCounts(const render::FrameStatistics& statistics, const std::string& where);

/// A benchmark's command line and run. The constructor adds --json; add the other options to options().
class GlBench {
 public:
  /// @param examples  end of --help
  GlBench(const char* name, const char* description, const char* examples);

  CLI::App& options() { return app_; }

  /// Parses the command line, makes a context, prints the head and runs the body. Then writes the JSON file, if one was
  /// asked for: {"head": {...}, "figures": ...}.
  /// @param body  measures, prints and fills the figures; may throw jalousie::Error and call require()
  /// @return  exit code: 0, 2 for a wrong command line, kWrongResult, or that of the Error
  int run(int argc, char** argv, const std::function<void(nlohmann::ordered_json& figures)>& body);

 private:
  std::string name_;
  CLI::App app_;
  std::filesystem::path json_;  ///< empty: none
  Replace replace_ = Replace::kSameKind;
};

}  // namespace jalousie::bench
