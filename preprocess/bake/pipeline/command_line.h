// Options of jalousie-bake.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bake/io/bake_options.h"
#include "bake/io/cut_document.h"
#include "core/output_files.h"

namespace jalousie::bake {

struct CommandLine {
  bool inspect = false;             ///< "inspect FILE": only inputs, json ("-" or empty), sheet and quiet matter
  std::optional<CutOptions> cut;    ///< "cut FILE -o OUT": only inputs, output, compress, json and quiet matter
  std::vector<std::string> inputs;  ///< files, folders, patterns
  std::filesystem::path filesFrom;  ///< a list of more inputs; empty: none; "-": standard input
  std::filesystem::path output;     ///< a file, or a folder for a batch
  bool keepExtension = false;
  std::filesystem::path json;     ///< empty: none; "-": standard output
  std::filesystem::path sheet;    ///< empty: none; a folder for a batch
  std::filesystem::path depfile;  ///< empty: none
  std::filesystem::path cache;    ///< empty: none
  std::uint64_t cacheLimit = 10ULL << 30U;
  std::optional<std::uint64_t> maxMemory;            ///< bytes of one bake, 0 for no limit; absent: by its size
  std::optional<std::chrono::milliseconds> timeout;  ///< of one bake, 0 for no limit; absent: by its size
  unsigned jobs = 0;                                 ///< 0: all cores
  bool quantize = false;
  bool compress = false;
  bool quiet = false;
  Replace replace = Replace::kSameKind;  ///< by the outputs, also those of a batch
  std::string chosen;                    ///< the given options that change the bytes of the output, in a fixed order
  BakeOptions bake;
};

/// Whether the output names a folder: it is one, or ends in a slash.
bool isBatch(const CommandLine& command);

/// Parses; nullopt after --help or --version was answered. Errors: kUsage.
std::optional<CommandLine> parseCommandLine(int argc, const char* const* argv);

}  // namespace jalousie::bake
