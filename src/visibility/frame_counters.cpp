// Counts the verdicts, levels and triangles object by object.
#include "visibility/frame_counters.h"

#include "core/check.h"
#include "policy/traits.h"
#include "scene/patch_base.h"
#include "scene/scene_data.h"
#include "visibility/draw_lists_reference.h"
#include "visibility/lod_policy.h"

namespace jalousie::visibility {

std::uint64_t trianglesOf(const scene::SceneData& scene, const gpu::Chain& chain, gpu::uint traits,
                          const gpu::ObjectState& state) {
  if (!has(traits, gpu::kTraitPatches)) return scene.lods[chain.firstLod + state.lod].triangleCount;
  return std::uint64_t{scene.lods[chain.patchLod].triangleCount} * scene::tessellatedTriangles(state.tessellation);
}

namespace {

/// kPlaced... bits of one object.
std::uint8_t placedBits(std::span<const std::uint8_t> placed, std::size_t object) {
  return placed.empty() ? kPlacedOwn | kPlacedFadingOut : placed[object];
}

/// One object that is on a list, or would be.
struct Drawn {
  const gpu::ObjectState& state;
  const gpu::Chain& chain;
  gpu::uint marks;
  std::uint8_t placed;
  bool early;
};

void countDrawn(FrameCounters& counters, const scene::SceneData& scene, gpu::uint traits, const Drawn& drawn) {
  const bool patches = has(traits, gpu::kTraitPatches);
  const bool fades = fadeFrames(drawn.marks) > 0 && !patches;
  const bool own = (drawn.placed & kPlacedOwn) != 0;
  const bool fadingOut = fades && (drawn.placed & kPlacedFadingOut) != 0;
  std::uint64_t triangles = 0;
  if (own) {
    ++counters[drawn.early ? gpu::kCounterEarly : gpu::kCounterLate];
    ++counters[gpu::kCounterLevels + (patches ? drawn.state.tessellation - 1 : drawn.state.lod)];
    if ((drawn.marks & gpu::kMarkSwitched) != 0) ++counters[gpu::kCounterSwitches];
    triangles += trianglesOf(scene, drawn.chain, traits, drawn.state);
  }
  if (fadingOut) triangles += scene.lods[drawn.chain.firstLod + fadingLod(drawn.state.lod, drawn.marks)].triangleCount;
  if (own && fadingOut) ++counters[gpu::kCounterFading];
  if (!own || fades != fadingOut) ++counters[gpu::kCounterDropped];
  for (gpu::uint limb = 0; limb < 4; ++limb)
    counters[gpu::kCounterTriangles + limb] += static_cast<gpu::uint>((triangles >> (10 * limb)) & 1023U);
}

}  // namespace

FrameCounters countStates(const scene::SceneData& scene, const gpu::CullView& view,
                          std::span<const gpu::ObjectState> states, std::span<const gpu::uint> marks,
                          const PlacedInstances& placed) {
  JAL_CHECK(states.size() == scene.objects.size());
  JAL_CHECK(marks.size() == scene.objects.size());
  FrameCounters counters = {};
  for (std::size_t i = 0; i < states.size(); ++i) {
    ++counters[gpu::kCounterVerdicts + states[i].verdict];
    if (!isDrawn(marks[i], view.traits)) continue;
    const bool early = has(view.traits, gpu::kTraitTwoPhases) && (marks[i] & gpu::kMarkEarly) != 0;
    countDrawn(counters, scene, view.traits,
               {states[i], scene.chains[scene.objects[i].chain], marks[i],
                placedBits(early ? placed.early : placed.late, i), early});
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
