// jalousie-scatter: writes copies of a baked object in a cube, with camera path and occluder, as one GLB.
#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "asset/gltf_file.h"
#include "asset/gltf_images.h"
#include "cli/program.h"
#include "core/error.h"
#include "core/memory_estimate.h"
#include "core/output_files.h"
#include "core/progress.h"
#include "core/standard_streams.h"
#include "scatter/command_line.h"
#include "scatter/report.h"
#include "scatter/scatter.h"

namespace {

using namespace jalousie;

/// Instances as vectors, in the document's buffer while it grows, and in the encoded file; the document itself, its
/// copy in the result, and the encoded file.
/// @param documentBytes  of buffers and pictures
void requireMemory(const scatter::Options& options, std::uint64_t documentBytes) {
  constexpr std::uint64_t kInstanceBytes = 2 * sizeof(glm::vec3) + sizeof(glm::quat);
  MemoryEstimate needs;
  needs.add(options.layout.count, 5 * kInstanceBytes, fmt::format("{} objects", options.layout.count));
  needs.add(documentBytes, 3, "the object");
  needs.require(options.memory, options.input);
}

std::uint64_t bytesOf(const tinygltf::Model& model) {
  std::uint64_t bytes = 0;
  for (const tinygltf::Buffer& buffer : model.buffers)
    bytes += buffer.data.size();
  for (const tinygltf::Image& image : model.images)
    bytes += image.image.size();
  return bytes;
}

void scatterFile(const scatter::Options& options) {
  std::error_code absent;
  const std::uintmax_t fileBytes = std::filesystem::file_size(options.input, absent);
  requireMemory(options, absent ? 0 : fileBytes);
  scatter::ScatteredScene scene;
  {
    Progress progress("scattering", options.layout.count, options.quiet);
    tinygltf::Model object = asset::loadGltf(options.input);
    requireMemory(options, bytesOf(object));
    asset::checkImages(object, options.input);
    scene = scatter::scatterObjects(std::move(object), options, progress);
    asset::saveGlb(scene.model, options.output);
  }
  if (!options.report.empty()) writeText(options.report, scatter::reportJson(options, scene.summary));
  if (options.report != kStandardOutput && !options.quiet)
    printOutput(fmt::format("{}: {}\n", oneLine(options.output.string()), scatter::reportLine(options, scene.summary)));
}

int run(int argc, char** argv) {
  const std::optional<scatter::Options> options = scatter::parseCommandLine(argc, argv);
  if (!options) return 0;
  checkOutputs(std::vector<NamedFile>{{"-o", options->output, OutputKind::kScene},
                                      {"--json", options->report, OutputKind::kReport, true}},
               std::vector{options->input}, options->replace);
  cli::withFile(options->input, [&] { scatterFile(*options); });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return cli::runProgram("jalousie-scatter", [&] { return run(argc, argv); });
}
