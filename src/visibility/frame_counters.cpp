// Counts object by object.
#include "visibility/frame_counters.h"

#include "core/check.h"
#include "policy/traits.h"
#include "scene/patch_base.h"
#include "visibility/lod_policy.h"

namespace jalousie::visibility {

std::uint64_t trianglesOf(const scene::SceneData& scene, const gpu::Chain& chain, gpu::uint traits,
                          const gpu::ObjectState& state) {
  if (!has(traits, gpu::kTraitPatches)) return scene.lods[chain.firstLod + state.lod].triangleCount;
  return std::uint64_t{scene.lods[chain.patchLod].triangleCount} * scene::tessellatedTriangles(state.tessellation);
}

FrameCounters countStates(const scene::SceneData& scene, const gpu::CullView& view,
                          std::span<const gpu::ObjectState> states, std::span<const gpu::uint> marks) {
  JAL_CHECK(states.size() == scene.objects.size());
  JAL_CHECK(marks.size() == scene.objects.size());
  FrameCounters counters = {};
  for (std::size_t i = 0; i < states.size(); ++i) {
    const gpu::ObjectState& state = states[i];
    ++counters[gpu::kCounterVerdicts + state.verdict];
    if (!isDrawn(marks[i], view.traits)) continue;
    const bool early = has(view.traits, gpu::kTraitTwoPhases) && (marks[i] & gpu::kMarkEarly) != 0;
    ++counters[early ? gpu::kCounterEarly : gpu::kCounterLate];
    const bool patches = has(view.traits, gpu::kTraitPatches);
    ++counters[gpu::kCounterLevels + (patches ? state.tessellation - 1 : state.lod)];
    const gpu::Chain& chain = scene.chains[scene.objects[i].chain];
    std::uint64_t triangles = trianglesOf(scene, chain, view.traits, state);
    if ((marks[i] & gpu::kMarkSwitched) != 0) ++counters[gpu::kCounterSwitches];
    if (fadeFrames(marks[i]) > 0 && !patches) {
      ++counters[gpu::kCounterFading];
      triangles += scene.lods[chain.firstLod + fadingLod(state.lod, marks[i])].triangleCount;
    }
    for (gpu::uint limb = 0; limb < 4; ++limb)
      counters[gpu::kCounterTriangles + limb] += static_cast<gpu::uint>((triangles >> (10 * limb)) & 1023U);
  }
  return counters;
}

std::uint64_t triangleSum(const FrameCounters& counters) {
  std::uint64_t sum = 0;
  for (gpu::uint limb = 0; limb < 4; ++limb)
    sum += std::uint64_t{counters[gpu::kCounterTriangles + limb]} << (10 * limb);
  return sum;
}

}  // namespace jalousie::visibility
