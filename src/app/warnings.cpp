// Prints the warnings of the program.
#include "app/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "asset/ignored_content.h"
#include "core/error.h"
#include "core/standard_streams.h"
#include "render/tessellation_limit.h"

namespace jalousie::app {

void warnIgnored(const std::filesystem::path& file, const asset::ContentCounts& ignored) {
  if (ignored.empty()) return;
  printError(
      fmt::format("jalousie: warning: {}: not drawn: {}", oneLine(file.string()), oneLine(asset::toText(ignored))));
}

void warnUnknownLevels(const std::filesystem::path& file, const scene::SceneData& scene, const LodRuleRow& rule) {
  const char* what = nullptr;
  if (usesErrors(rule) && scene.hasUnmeasuredLevels)
    what = "some levels carry no measured error and are never chosen by error";
  if (rule.followsCoverage && scene.hasUncoveredChains)
    what = "some chains have no valid MSFT_screencoverage and are drawn at LOD 0";
  if (what == nullptr) return;
  printError(fmt::format("jalousie: warning: {}: {}; bake the file with jalousie-bake", oneLine(file.string()), what));
}

void warnSingleFrame(const std::filesystem::path& file) {
  printError(fmt::format(
      "jalousie: warning: {}: the camera does not move, so one frame is measured; `jalousie record` makes a path",
      oneLine(file.string())));
}

void warnTessellationLimit(const std::filesystem::path& file, const scene::SceneData& scene,
                           const gl::Capabilities& capabilities, gpu::uint wanted) {
  const gpu::uint limit = render::tessellationLimit(capabilities, scene.maxPatchTriangles);
  if (limit >= wanted) return;
  printError(fmt::format(
      "jalousie: warning: {}: tessellation limited to level {}: the base mesh has {} triangles and this software "
      "renderer drops vertices above that",
      oneLine(file.string()), limit, scene.maxPatchTriangles));
}

void warnTriangleBudget(const std::filesystem::path& file, std::uint64_t budget,
                        const render::FrameStatistics& statistics, std::uint32_t settle) {
  constexpr std::uint32_t kSettledFrames = 60;
  const std::uint64_t drawn = statistics.triangles;
  const std::vector<std::uint64_t>& levels = statistics.lodHistogram;
  const bool allFinest = std::all_of(levels.begin() + std::min<std::ptrdiff_t>(1, std::ssize(levels)), levels.end(),
                                     [](std::uint64_t objects) { return objects == 0; });
  if (drawn < budget && allFinest) return;  // there is no more to draw
  const std::uint64_t missed = drawn > budget ? drawn - budget : budget - drawn;
  if (budget == 0 || missed <= budget / 20) return;
  printError(fmt::format(
      "jalousie: warning: {}: {} triangles are drawn instead of {}: {}", oneLine(file.string()), drawn, budget,
      settle < kSettledFrames
          ? "the price needs more frames (--settle 60)"
          : "the price found no nearer choice of levels; with --calm, or another budget, there may be one"));
}

}  // namespace jalousie::app
