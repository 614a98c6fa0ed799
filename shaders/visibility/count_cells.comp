// Figures of the cells that one draw list holds, summed on the GPU: cells and triangles. Marks the objects of which
// anything is drawn, for count_states.comp.
//
// One thread: one cell. Reads cells, chains, lods, cellStates, cellMarks, and the slots that scatter.comp left. Writes
// objectMarks. Adds to counters, which the frame cleared.
// Barrier owed: SHADER_STORAGE for count_states.comp. CPU twin: src/visibility/frame_counters.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"
#include "lib/fading.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std140, binding = kBindingListView) uniform ListViewBlock { ListView listView; };
layout(std430, binding = kBindingObjects) readonly buffer CellBlock { Object cells[]; };
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
layout(std430, binding = kBindingLods) readonly buffer LodBlock { Lod lods[]; };
layout(std430, binding = kBindingStates) readonly buffer CellStateBlock { ObjectState cellStates[]; };
layout(std430, binding = kBindingMarks) readonly buffer CellMarkBlock { uint cellMarks[]; };
layout(std430, binding = kBindingSlotsOfList) readonly buffer SlotBlock { uint slots[]; };
layout(std430, binding = kBindingObjectMarks) buffer ObjectMarkBlock { uint objectMarks[]; };
layout(std430, binding = kBindingCounters) buffer CounterBlock { uint counters[]; };

#include "lib/count_triangles.glsl"

/// Adds a cell at one level. @param placedMark  kMarkPlaced or kMarkPlacedFading
void countLevel(uint id, uint lod, uint slot, uint placedMark) {
  uint triangles = lods[chains[cells[id].chain].firstLod + lod].triangleCount;
  if (triangles == 0u) return;
  if (slot == kNoBin) {
    atomicAdd(groupCounters[kCounterDropped], 1u);
    return;
  }
  atomicOr(objectMarks[cells[id].object], placedMark);
  if (placedMark == kMarkPlaced) atomicAdd(groupCounters[kCounterCells], 1u);
  countTriangles(triangles);
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  groupCounters[lane] = 0u;
  barrier();
  uint id = threadNumber();
  if (id < cullView.cellCount && (cellMarks[id] & listView.phase) != 0u) {
    uint mark = cellMarks[id];
    uint lod = cellStates[id].lod;
    countLevel(id, lod, slots[2u * id], kMarkPlaced);
    if (fadeFrames(mark) > 0u) countLevel(id, fadingLod(lod, mark), slots[2u * id + 1u], kMarkPlacedFading);
  }
  barrier();
  addGroupCounters(lane);
}
