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

std::uint8_t placedCellBits(gpu::uint marks) {
  return static_cast<std::uint8_t>(((marks & gpu::kMarkPlaced) != 0 ? kPlacedOwn : 0) |
                                   ((marks & gpu::kMarkPlacedFading) != 0 ? kPlacedFadingOut : 0));
}

/// One object that is on a list, or would be.
struct Drawn {
  const gpu::ObjectState& state;
  const gpu::Chain& chain;
  gpu::uint marks;
  std::uint8_t placed;
  bool early;
};

void addTriangles(FrameCounters& counters, std::uint64_t triangles) {
  for (gpu::uint limb = 0; limb < 4; ++limb)
    counters[gpu::kCounterTriangles + limb] += static_cast<gpu::uint>((triangles >> (10 * limb)) & 1023U);
}

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
  if (!scene.cells.objects.empty()) return;  // countCells has counted what follows
  if (!own || fades != fadingOut) ++counters[gpu::kCounterDropped];
  addTriangles(counters, triangles);
}

/// The cells of one list. @param phase  kMarkEarly or kMarkLate
void countCellsOf(const scene::SceneData& scene, const CellDecisions& cells, gpu::uint phase,
                  std::span<gpu::uint> objectMarks, FrameCounters& counters) {
  const std::span<const std::uint8_t> placed = phase == gpu::kMarkEarly ? cells.placed.early : cells.placed.late;
  for (std::size_t i = 0; i < cells.marks.size(); ++i) {
    if ((cells.marks[i] & phase) == 0) continue;
    const gpu::Object& cell = scene.cells.objects[i];
    const gpu::uint firstLod = scene.cells.chains[cell.chain].firstLod;
    const auto countLevel = [&](gpu::uint lod, std::uint8_t bit, gpu::uint mark) {
      const gpu::uint triangles = scene.cells.lods[firstLod + lod].triangleCount;
      if (triangles == 0) return;
      if ((placedBits(placed, i) & bit) == 0) {
        ++counters[gpu::kCounterDropped];
        return;
      }
      objectMarks[cell.object] |= mark;
      if (bit == kPlacedOwn) ++counters[gpu::kCounterCells];
      addTriangles(counters, triangles);
    };
    countLevel(cells.states[i].lod, kPlacedOwn, gpu::kMarkPlaced);
    if (fadeFrames(cells.marks[i]) > 0)
      countLevel(fadingLod(cells.states[i].lod, cells.marks[i]), kPlacedFadingOut, gpu::kMarkPlacedFading);
  }
}

}  // namespace

FrameCounters countCells(const scene::SceneData& scene, const gpu::CullView& view, const CellDecisions& cells,
                         std::span<gpu::uint> objectMarks) {
  JAL_CHECK(cells.states.size() == scene.cells.objects.size());
  JAL_CHECK(cells.marks.size() == scene.cells.objects.size());
  FrameCounters counters = {};
  if (has(view.traits, gpu::kTraitTwoPhases)) countCellsOf(scene, cells, gpu::kMarkEarly, objectMarks, counters);
  countCellsOf(scene, cells, gpu::kMarkLate, objectMarks, counters);
  return counters;
}

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
    const std::uint8_t bits =
        scene.cells.objects.empty() ? placedBits(early ? placed.early : placed.late, i) : placedCellBits(marks[i]);
    countDrawn(counters, scene, view.traits, {states[i], scene.chains[scene.objects[i].chain], marks[i], bits, early});
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
