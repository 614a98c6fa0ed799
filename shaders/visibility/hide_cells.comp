// After hide_objects.comp: the cells of hidden objects are hidden.
//
// One thread: one cell. Reads cells, states and marks of the objects. Writes cellStates, cellMarks.
// Barrier owed: SHADER_STORAGE. CPU twin: src/visibility/slice_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std430, binding = kBindingObjects) readonly buffer CellBlock { Object cells[]; };
layout(std430, binding = kBindingStates) readonly buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingMarks) readonly buffer MarkBlock { uint marks[]; };
layout(std430, binding = kBindingCellStates) buffer CellStateBlock { ObjectState cellStates[]; };
layout(std430, binding = kBindingCellMarks) buffer CellMarkBlock { uint cellMarks[]; };

void main() {
  uint id = threadNumber();
  if (id >= cullView.cellCount) return;
  uint object = cells[id].object;
  if ((marks[object] & kMarkLate) != 0u) return;
  cellStates[id].verdict = states[object].verdict;
  cellMarks[id] &= ~(kMarkLate | kMarkVisible);
}
