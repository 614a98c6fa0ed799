// Culling of cells, one at a time.
#include "visibility/cell_reference.h"

#include "policy/traits.h"
#include "scene/scene_data.h"
#include "visibility/classify_reference.h"
#include "visibility/lod_policy.h"

namespace jalousie::visibility {
namespace {

static_assert(gpu::kMarkOfObject == (gpu::kMarkMirrored | gpu::kMarkFadeMask | gpu::kMarkMapLodMask));
static_assert(gpu::kMarkPhases == (gpu::kMarkEarly | gpu::kMarkLate | gpu::kMarkVisible));

/// Bounds of what a cell draws: at its object's level and, in a cross-fade, at the level that fades out.
Aabb drawnBounds(const CellInput& input) {
  const scene::CellTables& cells = input.scene.cells;
  const gpu::uint first = cells.chains[cells.objects[input.cell].chain].firstLod;
  const auto boundsAt = [&](gpu::uint lod) {
    const gpu::CellBounds& bounds = cells.bounds[first + lod];
    return Aabb{glm::vec3(bounds.minObject), glm::vec3(bounds.maxObject)};
  };
  const ObjectDecision& object = input.object;
  Aabb drawn = boundsAt(object.state.lod);
  if (fadeFrames(object.marks) > 0) drawn.add(boundsAt(fadingLod(object.state.lod, object.marks)));
  return drawn;
}

BoxOnScreen cellOnScreen(const CellInput& input, const Aabb& drawn) {
  const gpu::Object& cell = input.scene.cells.objects[input.cell];
  return boxOnScreen(input.scene.transforms[cell.transform], drawn, input.view.clipFromWorld,
                     glm::vec2(input.view.viewportWidth, input.view.viewportHeight), input.rounding);
}

bool isInView(gpu::uint verdict) {
  return verdict != gpu::kVerdictOutside && verdict != gpu::kVerdictSmall;
}

gpu::uint phasesOfCell(const gpu::CullView& view, const BoxOnScreen& box, gpu::uint objectMarks, gpu::uint lastMarks) {
  if (!has(view.traits, gpu::kTraitTwoPhases) || view.cullCells == 0)
    return objectMarks & (gpu::kMarkPhases | gpu::kMarkTested);
  // Nothing is known of the cells of an object that was not drawn before: all of them follow it.
  const bool isNew = (objectMarks & gpu::kMarkKnown) == 0;
  const bool expected = box.crossesNear || isNew || isExpectedVisible(lastMarks, box.rect, view);
  const bool early = (objectMarks & gpu::kMarkEarly) != 0 && expected;
  return early ? gpu::kMarkEarly | gpu::kMarkVisible | gpu::kMarkTested : gpu::kMarkTested;
}

bool isOccluded(const gpu::CullView& view, const BoxOnScreen& box, const Cover& cover, float guardPixels) {
  if (!cover.depthAware() || box.crossesNear) return false;
  gpu::ScreenBox screen{};
  screen.minX = box.rect.x;
  screen.minY = box.rect.y;
  screen.maxX = box.rect.z;
  screen.maxY = box.rect.w;
  screen.nearestDepth = box.nearestDepth;
  return testOverlap(cover, screen, view.cullThreshold, guardPixels, std::nullopt).verdict == gpu::kVerdictOccluded;
}

}  // namespace

CellDecision classifyCell(const CellInput& input, gpu::uint lastMarks) {
  const gpu::CullView& view = input.view;
  const ObjectDecision& object = input.object;
  CellDecision result{object.state, object.marks & gpu::kMarkOfObject};
  if (!isInView(object.state.verdict)) return result;
  const Aabb drawn = drawnBounds(input);
  const bool tested = has(view.traits, gpu::kTraitCulls) && view.cullCells != 0;
  if (!drawn.empty()) {
    const BoxOnScreen box = cellOnScreen(input, drawn);
    if (!(tested && box.outside)) result.marks |= phasesOfCell(view, box, object.marks, lastMarks);
  }
  // The map has a level of its own, which may have triangles where the drawn one has none.
  if (object.state.verdict == gpu::kVerdictOccluder) result.marks |= gpu::kMarkEarly;
  return result;
}

void analyseCell(const CellInput& input, const Cover& cover, float guardPixels, CellDecision& decided) {
  const gpu::CullView& view = input.view;
  const ObjectDecision& object = input.object;
  if (!isInView(object.state.verdict)) return;
  const bool drawnIntoMap = object.state.verdict == gpu::kVerdictOccluder || object.state.verdict == gpu::kVerdictNear;
  if (!has(view.traits, gpu::kTraitTwoPhases) && drawnIntoMap) return;
  const gpu::uint early = decided.marks & gpu::kMarkEarly;
  decided = {object.state, (object.marks & gpu::kMarkOfObject) | early};
  const Aabb drawn = drawnBounds(input);
  if (drawn.empty()) return;
  const BoxOnScreen box = cellOnScreen(input, drawn);
  if (view.cullCells != 0 && box.outside) return;
  decided.marks |= gpu::kMarkTested;
  const bool visible =
      (object.marks & gpu::kMarkVisible) != 0 && (view.cullCells == 0 || !isOccluded(view, box, cover, guardPixels));
  if (visible) decided.marks |= early != 0 ? gpu::kMarkVisible : gpu::kMarkVisible | gpu::kMarkLate;
}

}  // namespace jalousie::visibility
