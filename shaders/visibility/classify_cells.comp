// Frustum culling of the cells of every object in view, and which of them are drawn before the occlusion test
// (docs/two_phase_culling.md, "Cells").
//
// One thread: one cell. Reads transforms, cells, chains, bounds; states and marks of the objects, as classify.comp left
// them; and cellMarks of the last frame. Writes cellStates, cellMarks.
// Barrier owed: SHADER_STORAGE for analyse_cells.comp and bin_objects.comp.
// CPU twin: src/visibility/cell_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"
#include "lib/transform.glsl"
#include "lib/frustum.glsl"
#include "lib/fading.glsl"
#include "lib/cells.glsl"
#include "lib/expectation.glsl"

layout(local_size_x = kObjectGroupSize) in;

/// Phases of a cell in view. @param lastMarks  of the cell, in the last frame
uint phasesOfCell(BoxOnScreen box, uint objectMark, uint lastMarks) {
  if (!hasTrait(kTraitTwoPhases) || cullView.cullCells == 0u) return objectMark & (kMarkPhases | kMarkTested);
  // Nothing is known of the cells of an object that was not drawn before: all of them follow it.
  bool isNew = (objectMark & kMarkKnown) == 0u;
  bool expected = box.crossesNear || isNew || isExpectedVisible(lastMarks, box.rect);
  bool early = (objectMark & kMarkEarly) != 0u && expected;
  return early ? kMarkEarly | kMarkVisible | kMarkTested : kMarkTested;
}

void main() {
  uint id = threadNumber();
  if (id >= cullView.cellCount) return;
  Object cell = cells[id];
  ObjectState state = states[cell.object];
  uint objectMark = marks[cell.object];
  uint mark = objectMark & kMarkOfObject;
  if (isInView(state.verdict)) {
    CellBounds drawn = drawnBounds(cell, state.lod, objectMark);
    bool tested = hasTrait(kTraitCulls) && cullView.cullCells != 0u;
    if (!isEmpty(drawn)) {
      BoxOnScreen box = cellOnScreen(cell, drawn);
      if (!(tested && box.outside)) mark |= phasesOfCell(box, objectMark, cellMarks[id]);
    }
    // The map has a level of its own, which may have triangles where the drawn one has none.
    if (state.verdict == kVerdictOccluder) mark |= kMarkEarly;
  }
  cellStates[id] = state;
  cellMarks[id] = mark;
}
