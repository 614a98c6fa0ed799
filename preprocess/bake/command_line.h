// Options of jalousie-bake.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "bake/bake_document.h"

namespace jalousie::bake {

struct CommandLine {
  bool inspect = false;  ///< "inspect FILE": only inputs, json ("-" or empty), sheet and quiet matter
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  std::filesystem::path json;   ///< empty: none; "-": standard output
  std::filesystem::path sheet;  ///< empty: none
  bool quantize = false;
  bool compress = false;
  bool quiet = false;
  BakeOptions bake;
};

/// Parses; nullopt after --help or --version was answered. Errors: kUsage.
std::optional<CommandLine> parseCommandLine(int argc, const char* const* argv);

}  // namespace jalousie::bake
