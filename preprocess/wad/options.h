// Options of jalousie-wad.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/output_files.h"

namespace jalousie::wad {

struct Options {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path report;  ///< empty: none
  std::string map;
  bool opensDoors = true;
  Replace replace = {};
  bool quiet = false;
};

/// Parses the arguments. After --help it prints the help and returns nullopt.
/// Errors: kUsage with a reason of one line; kWriteFailed where the help cannot be printed
std::optional<Options> parseCommandLine(int argc, const char* const* argv);

}  // namespace jalousie::wad
