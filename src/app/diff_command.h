// `jalousie diff`: PSNR, SSIM, FLIP and Butteraugli of one picture against another.
#pragma once

#include <filesystem>
#include <string>

#include "compare/image_error.h"
#include "core/memory_limit.h"
#include "core/output_files.h"

namespace CLI {
class App;
}

namespace jalousie::app {

struct DiffOptions {
  std::filesystem::path reference;
  std::filesystem::path test;
  std::filesystem::path output;  ///< of the error map; empty: none
  std::string json;              ///< file; "-": standard output; empty: none
  MemoryLimit memory{kDefaultMaxMemory, "--max-memory"};
  Replace replace = Replace::kSameKind;
  double pixelsPerDegree = compare::kDefaultPixelsPerDegree;
};

/// Declares the options on a subcommand; values land in options, which must outlive the parse.
void addDiffOptions(CLI::App& command, DiffOptions& options);

/// Prints the figures, unless JSON goes to standard output. Errors: kUsage for pictures of different or too small size;
/// as loadImage and writeFileAtomic.
void runDiff(const DiffOptions& options);

}  // namespace jalousie::app
