// Figures of the frame, summed on the GPU: verdicts, levels, triangles (docs/formats.md). Sums of whole numbers do not
// depend on their order, so atomics leave the result the same in every run.
//
// JAL_CELLS: scenes with cells. count_cells.comp has counted triangles, and marked the objects of which some are drawn.
// One thread: one object. Reads states, marks, objects, chains, lods, and the slots that scatter.comp left. Adds to
// counters, which the frame cleared.
// Barrier owed: BUFFER_UPDATE for the copy into the ring. CPU twin: src/visibility/frame_counters.cpp
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
layout(std430, binding = kBindingLods) readonly buffer LodBlock { Lod lods[]; };
layout(std430, binding = kBindingStates) readonly buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingMarks) readonly buffer MarkBlock { uint marks[]; };
layout(std430, binding = kBindingEarlySlots) readonly buffer EarlySlotBlock { uint earlySlots[]; };
layout(std430, binding = kBindingLateSlots) readonly buffer LateSlotBlock { uint lateSlots[]; };
layout(std430, binding = kBindingCounters) buffer CounterBlock { uint counters[]; };

#include "lib/lod.glsl"
#include "lib/count_triangles.glsl"

/// An object whose own instance is on a list. @return  its triangles
uint countDrawn(ObjectState state, Chain chain, uint mark, bool early) {
  bool patches = hasTrait(kTraitPatches);
  atomicAdd(groupCounters[early ? kCounterEarly : kCounterLate], 1u);
  if ((mark & kMarkSwitched) != 0u) atomicAdd(groupCounters[kCounterSwitches], 1u);
  atomicAdd(groupCounters[kCounterLevels + (patches ? state.tessellation - 1u : state.lod)], 1u);
  return trianglesAt(chain, state);
}

void countObject(uint id) {
  ObjectState state = states[id];
  uint mark = marks[id];
  atomicAdd(groupCounters[kCounterVerdicts + state.verdict], 1u);
  bool early = hasTrait(kTraitTwoPhases) && (mark & kMarkEarly) != 0u;
  if (!early && (mark & kMarkLate) == 0u) return;
  Chain chain = chains[objects[id].chain];
  bool fades = fadeFrames(mark) > 0u && !hasTrait(kTraitPatches);
#ifdef JAL_CELLS
  bool placed = (mark & kMarkPlaced) != 0u;
  bool fadingPlaced = fades && (mark & kMarkPlacedFading) != 0u;
#else
  bool placed = (early ? earlySlots[2u * id] : lateSlots[2u * id]) != kNoBin;
  bool fadingPlaced = fades && (early ? earlySlots[2u * id + 1u] : lateSlots[2u * id + 1u]) != kNoBin;
#endif
  uint triangles = placed ? countDrawn(state, chain, mark, early) : 0u;
  if (fadingPlaced) triangles += fadingTriangles(chain, state.lod, mark);
  if (placed && fadingPlaced) atomicAdd(groupCounters[kCounterFading], 1u);
#ifndef JAL_CELLS  // count_cells.comp counts triangles and what found no room
  if (!placed || fades != fadingPlaced) atomicAdd(groupCounters[kCounterDropped], 1u);
  countTriangles(triangles);
#endif
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  groupCounters[lane] = 0u;
  barrier();
  uint id = threadNumber();
  if (id < cullView.objectCount) countObject(id);
  barrier();
  addGroupCounters(lane);
}
