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
#include "scatter/layout.h"
#include "scatter/report.h"
#include "scatter/scatter.h"
#include "scatter/source_asset.h"

namespace {

using namespace jalousie;

/// Instances as vectors, in the document's buffer while it grows, and in the encoded file; the document itself, its
/// copy in the result, and the encoded file.
/// @param documentBytes  of buffers and pictures
/// @param perObject      instances of meshes that one object becomes
void requireMemory(const scatter::Options& options, std::uint64_t documentBytes, std::uint64_t perObject) {
  constexpr std::uint64_t kInstanceBytes = 2 * sizeof(glm::vec3) + sizeof(glm::quat);
  const std::uint64_t most = asset::Limits{}.maxInstances;
  const std::uint64_t instances = saturatingProduct(options.layout.count, perObject);
  if (instances > most)
    throw Error(ErrorCode::kLimit, fmt::format("{} objects of {} meshes are more than {} instances",
                                               options.layout.count, perObject, most));
  MemoryEstimate needs;
  needs.add(instances, 5 * kInstanceBytes, fmt::format("{} instances", instances));
  needs.add(perObject, sizeof(scatter::Pose) + kInstanceBytes, fmt::format("{} meshes", perObject));
  needs.add(options.layout.count, sizeof(scatter::Placement), fmt::format("{} objects", options.layout.count));
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

/// One line for each kind of content that is left out.
void warnIgnored(const scatter::Options& options, const asset::ContentCounts& ignored) {
  for (const auto& [name, count] : ignored)
    printError(fmt::format("jalousie-scatter: warning: {}: not scattered: {} {}", oneLine(options.input.string()),
                           count, name));
}

void scatterFile(const scatter::Options& options) {
  std::error_code absent;
  const std::uintmax_t fileBytes = std::filesystem::file_size(options.input, absent);
  requireMemory(options, absent ? 0 : fileBytes, 1);
  scatter::ScatteredScene scene;
  {
    Progress progress("scattering", options.layout.count, options.quiet);
    tinygltf::Model object = asset::loadGltf(options.input);
    requireMemory(options, bytesOf(object), scatter::instancesPerObject(object));
    asset::checkImages(object, options.input);
    scene = scatter::scatterObjects(std::move(object), options, progress);
    asset::saveGlb(scene.model, options.output);
  }
  if (!options.quiet) warnIgnored(options, scene.summary.ignored);
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
