// Marks what the frame did not draw, at its coarsest level, for a draw list of its own (the ghost view).
//
// JAL_CELLS: the objects here are cells. They stay at the level of their object: at another one, triangles of a cell
// that is drawn may belong to a cell that is not.
// One thread: one object. Reads objects, chains, states, marks. Writes ghostStates, ghostMarks.
// Barrier owed: SHADER_STORAGE for bin_objects.comp. CPU twin: src/visibility/ghost_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
#include "lib/traits.glsl"
layout(std430, binding = kBindingObjects) readonly buffer ObjectBlock { Object objects[]; };
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
layout(std430, binding = kBindingStates) readonly buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingMarks) readonly buffer MarkBlock { uint marks[]; };
layout(std430, binding = kBindingGhostStates) writeonly buffer GhostStateBlock { ObjectState ghostStates[]; };
layout(std430, binding = kBindingGhostMarks) writeonly buffer GhostMarkBlock { uint ghostMarks[]; };

void main() {
  uint id = threadNumber();
#ifdef JAL_CELLS
  if (id >= cullView.cellCount) return;
  uint lod = states[id].lod;
#else
  if (id >= cullView.objectCount) return;
  uint lod = chains[objects[id].chain].lodCount - 1u;
#endif
  uint mark = marks[id];
  uint drawn = mark & (hasTrait(kTraitTwoPhases) ? kMarkEarly | kMarkLate : kMarkLate);
  ghostMarks[id] = drawn != 0u ? 0u : kMarkLate | (mark & kMarkMirrored);
  ghostStates[id] = ObjectState(states[id].verdict, lod, 1u, 1.0);
}
