// Occlusion test of the cells of every object that passed its own (docs/two_phase_culling.md, "Cells").
//
// One thread: one cell. Reads transforms, cells, chains, bounds; states and marks of the objects, as analyse.comp left
// them; cellMarks as classify_cells.comp left them; and the map or pyramid. Writes cellStates, cellMarks.
// Barrier owed: SHADER_STORAGE for bin_objects.comp. CPU twin: src/visibility/cell_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"
#include "lib/transform.glsl"
#include "lib/frustum.glsl"
#include "lib/overlap.glsl"
#include "lib/fading.glsl"
#include "lib/cells.glsl"
#include "lib/occlusion_test.glsl"

layout(local_size_x = kObjectGroupSize) in;

/// Whether the pyramid shows that nothing of a box can be seen. An occlusion map alone does not say how far away its
/// occluders are: it is only asked about whole objects, as in the thesis.
bool isOccluded(BoxOnScreen box) {
#ifdef JAL_USES_DEPTH
  return !box.crossesNear && overlap(probeOf(box.rect, box.nearestDepth)).x >= cullView.cullThreshold;
#else
  return false;
#endif
}

/// The levels of objects that are drawn late may have changed since classify_cells.comp: all is decided again.
void main() {
  uint id = threadNumber();
  if (id >= cullView.cellCount) return;
  Object cell = cells[id];
  ObjectState state = states[cell.object];
  uint objectMark = marks[cell.object];
  if (!isInView(state.verdict)) return;
  // Occluders, and objects across the near plane that are drawn into the map, are in front of what it covers.
  if (!hasTrait(kTraitTwoPhases) && (state.verdict == kVerdictOccluder || state.verdict == kVerdictNear)) return;
  uint early = cellMarks[id] & kMarkEarly;
  uint mark = (objectMark & kMarkOfObject) | early;
  CellBounds drawn = drawnBounds(cell, state.lod, objectMark);
  if (!isEmpty(drawn)) {
    BoxOnScreen box = cellOnScreen(cell, drawn);
    if (cullView.cullCells == 0u || !box.outside) {
      mark |= kMarkTested;
      bool visible = (objectMark & kMarkVisible) != 0u && (cullView.cullCells == 0u || !isOccluded(box));
      if (visible) mark |= early != 0u ? kMarkVisible : kMarkVisible | kMarkLate;
    }
  }
  cellStates[id] = state;
  cellMarks[id] = mark;
}
