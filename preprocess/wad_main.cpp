// jalousie-wad: converts a level of a WAD file to glTF with rooms and portals.
#include <fmt/format.h>

#include <optional>
#include <vector>

#include "asset/gltf_file.h"
#include "cli/program.h"
#include "core/error.h"
#include "core/file.h"
#include "core/output_files.h"
#include "core/standard_streams.h"
#include "wad/convert.h"
#include "wad/options.h"

namespace {

using namespace jalousie;

/// A level that is not there names the file as well.
wad::ConvertedLevel levelOf(const wad::WadFile& file, const wad::Options& options) {
  try {
    return wad::convertLevel(file, options.map, options.opensDoors);
  } catch (const Error& error) {
    throw Error(error.code(), error.what(), options.input);
  }
}

void convertFile(const wad::Options& options) {
  const wad::WadFile file(readFile(options.input, wad::WadFile::kMostBytes));
  const wad::ConvertedLevel level = levelOf(file, options);
  asset::saveGlb(level.model, options.output);
  if (!options.report.empty()) writeText(options.report, wad::reportJson(level.summary));
  if (options.report != kStandardOutput && !options.quiet)
    printOutput(fmt::format("{}: {}\n", oneLine(options.output.string()), wad::reportLine(level.summary)));
}

int run(int argc, char** argv) {
  const std::optional<wad::Options> options = wad::parseCommandLine(argc, argv);
  if (!options) return 0;
  checkOutputs(std::vector<NamedFile>{{"-o", options->output, OutputKind::kScene},
                                      {"--json", options->report, OutputKind::kReport, true}},
               std::vector{options->input}, options->replace);
  cli::withFile(options->input, [&] { convertFile(*options); });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return cli::runProgram("jalousie-wad", [&] { return run(argc, argv); });
}
