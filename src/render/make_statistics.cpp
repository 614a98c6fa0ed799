// Reads the counters by name.
#include "render/make_statistics.h"

#include <algorithm>

#include "policy/traits.h"
#include "scene/patch_base.h"

namespace jalousie::render {

FinestTriangles countFinestTriangles(const scene::SceneData& scene) {
  FinestTriangles full;
  for (const gpu::Object& object : scene.objects) {
    const gpu::Chain& chain = scene.chains[object.chain];
    full.discrete += scene.lods[chain.firstLod].triangleCount;
    full.patchBase += scene.lods[chain.patchLod].triangleCount;
  }
  for (const gpu::Chain& chain : scene.chains)
    full.maxLods = std::max(full.maxLods, chain.lodCount);
  return full;
}

FrameStatistics makeStatistics(const visibility::FrameCounters& counters, const gpu::CullView& view,
                               const FinestTriangles& full) {
  const auto verdicts = [&](gpu::uint verdict) -> std::uint64_t { return counters[gpu::kCounterVerdicts + verdict]; };
  const bool patches = has(view.traits, gpu::kTraitPatches);
  FrameStatistics result;
  result.objects = view.objectCount;
  result.culledFrustum = verdicts(gpu::kVerdictOutside);
  result.culledOcclusion = verdicts(gpu::kVerdictOccluded);
  result.culledSmall = verdicts(gpu::kVerdictSmall);
  result.occluders = verdicts(gpu::kVerdictOccluder);
  result.drawnStale = verdicts(gpu::kVerdictStale);
  result.drawnEarly = counters[gpu::kCounterEarly];
  result.drawn = result.drawnEarly + counters[gpu::kCounterLate];
  result.switches = counters[gpu::kCounterSwitches];
  result.fading = counters[gpu::kCounterFading];
  result.dropped = counters[gpu::kCounterDropped];
  result.cells = view.cellCount;
  result.cellsDrawn = counters[gpu::kCounterCells];
  result.triangles = visibility::triangleSum(counters);
  result.trianglesFinest = patches ? full.patchBase * scene::tessellatedTriangles(view.maxTessellation) : full.discrete;
  const gpu::uint levels = patches ? view.maxTessellation : full.maxLods;
  for (gpu::uint level = 0; level < levels; ++level)
    result.lodHistogram.push_back(counters[gpu::kCounterLevels + level]);
  return result;
}

}  // namespace jalousie::render
