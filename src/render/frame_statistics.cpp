// Plain counting on the CPU; runs after the frame, never inside it.
#include "render/frame_statistics.h"

#include <algorithm>

#include "core/check.h"
#include "scene/patch_base.h"
#include "visibility/commands_reference.h"

namespace jalousie::render {
namespace {

/// Triangles of one object at a level of its path.
std::uint64_t trianglesOf(const scene::SceneData& scene, const gpu::Chain& chain, gpu::uint detail, gpu::uint lod,
                          gpu::uint tessellation) {
  if (detail == gpu::kDetailDiscrete) return scene.lods[chain.firstLod + lod].triangleCount;
  return std::uint64_t{scene.lods[chain.patchLod].triangleCount} * scene::tessellatedTriangles(tessellation);
}

std::size_t histogramSize(const scene::SceneData& scene, const gpu::CullView& view) {
  if (view.detail == gpu::kDetailTessellation) return view.maxTessellation;
  std::uint32_t size = 0;
  for (const gpu::Chain& chain : scene.chains)
    size = std::max(size, chain.lodCount);
  return size;
}

}  // namespace

FrameStatistics countFrame(const scene::SceneData& scene, const gpu::CullView& view,
                           std::span<const gpu::ObjectState> states) {
  JAL_CHECK(states.size() == scene.objects.size());
  FrameStatistics result;
  result.objects = states.size();
  result.lodHistogram.resize(histogramSize(scene, view));
  for (std::size_t i = 0; i < states.size(); ++i) {
    const gpu::ObjectState& state = states[i];
    const gpu::Chain& chain = scene.chains[scene.objects[i].chain];
    result.trianglesFull += trianglesOf(scene, chain, view.detail, 0, view.maxTessellation);
    result.culledFrustum += state.verdict == gpu::kVerdictOutside ? 1 : 0;
    result.culledOcclusion += state.verdict == gpu::kVerdictOccluded ? 1 : 0;
    result.occluders += state.verdict == gpu::kVerdictOccluder ? 1 : 0;
    if (!visibility::isDrawn(state.verdict)) continue;
    ++result.drawn;
    result.triangles += trianglesOf(scene, chain, view.detail, state.lod, state.tessellation);
    ++result.lodHistogram[view.detail == gpu::kDetailTessellation ? state.tessellation - 1 : state.lod];
  }
  return result;
}

}  // namespace jalousie::render
