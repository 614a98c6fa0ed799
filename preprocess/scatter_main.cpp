// jalousie-scatter: writes copies of a baked object in a cube, with camera path and occluder, as one GLB.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <optional>
#include <utility>

#include "asset/gltf_file.h"
#include "core/error.h"
#include "core/file.h"
#include "core/progress.h"
#include "scatter/command_line.h"
#include "scatter/report.h"
#include "scatter/scatter.h"

namespace {

using namespace jalousie;

void run(const scatter::Options& options) {
  scatter::ScatteredScene scene;
  {
    Progress progress("scattering", options.layout.count, options.quiet);
    scene = scatter::scatterObjects(asset::loadGltf(options.input), options, progress);
    asset::saveGlb(scene.model, options.output);
  }
  if (!options.report.empty()) writeFileAtomic(options.report, scatter::reportJson(options, scene.summary));
  if (!options.quiet) fmt::print("{}: {}\n", options.output.string(), scatter::reportLine(options, scene.summary));
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path input;
  try {
    const std::optional<scatter::Options> options = scatter::parseCommandLine(argc, argv);
    if (!options) return 0;
    input = options->input;
    run(*options);
    return 0;
  } catch (const Error& error) {
    // Errors about the input's content carry no path of their own.
    const bool aboutInput = error.file().empty() && error.code() != ErrorCode::kUsage;
    const std::string prefix = aboutInput ? input.string() + ": " : "";
    fmt::print(stderr, "jalousie-scatter: {}{}\n", prefix, error.what());
    return error.exitCode();
  } catch (const std::exception& error) {
    fmt::print(stderr, "jalousie-scatter: {}\n", error.what());
    return static_cast<int>(ErrorCode::kInternal);
  }
}
