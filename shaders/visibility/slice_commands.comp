// One command per object at a fixed place, so that a frame can be drawn in slices: places follow the spatial hierarchy,
// and what lies below a node is a range of commands. Where the scene has cells, the objects here are cells. The second
// half of the commands draws the levels that fade out.
//
// One thread: one place. Reads order, objects, chains, lods, states, marks. Writes commands, instances.
// Barrier owed: COMMAND, VERTEX_ATTRIB_ARRAY, and SHADER_STORAGE for drop_hidden.comp.
// CPU twin: src/visibility/draw_lists_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/query_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
#include "lib/traits.glsl"
#include "lib/fading.glsl"
#include "lib/bins.glsl"
layout(std140, binding = kBindingSliceView) uniform SliceViewBlock { SliceView sliceView; };
layout(std430, binding = kBindingOrder) readonly buffer OrderBlock { uint order[]; };
layout(std430, binding = kBindingObjects) readonly buffer ObjectBlock { Object objects[]; };
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
layout(std430, binding = kBindingLods) readonly buffer LodBlock { Lod lods[]; };
layout(std430, binding = kBindingStates) readonly buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingMarks) readonly buffer MarkBlock { uint marks[]; };
layout(std430, binding = kBindingSliceInstances) writeonly buffer InstanceBlock { uint instances[]; };
#include "lib/commands.glsl"

void writeEmpty(uint place) {
  for (uint list = 0u; list < sliceView.listCount; ++list)
    commands[list * sliceView.commandCapacity + place] = DrawCommand(0u, 0u, 0u, 0, 0u);
}

void writeBin(uint place, Chain chain, uint bin, uint instance) {
  Ranges ranges = rangesOf(chain, bin);
  for (uint list = 0u; list < sliceView.listCount; ++list) {
    bool listed = list >= ranges.firstList && list < ranges.firstList + kListsPerDetail;
    uint k = listed ? list - ranges.firstList : 0u;
    uint count = listed ? ranges.count[k] : 0u;
    commands[list * sliceView.commandCapacity + place] =
        DrawCommand(count, count > 0u ? 1u : 0u, ranges.firstIndex[k], ranges.baseVertex, place);
  }
  instances[place] = instance;
}

void main() {
  uint place = threadNumber();
  if (place >= sliceView.unitCount) return;
  uint id = order[place];
  uint mark = marks[id];
  writeEmpty(place + sliceView.unitCount);
  if ((mark & kMarkLate) == 0u) {
    writeEmpty(place);
    return;
  }
  ObjectState state = states[id];
  Chain chain = chains[objects[id].chain];
  bool fades = hasFadingLevel(mark, false);
  writeBin(place, chain, binOfLevel(state, mark, false), fades ? id | kInstanceFadingIn : id);
  if (fades) writeBin(place + sliceView.unitCount, chain, fadingBinOfLevel(state, mark), id | kInstanceFadingOut);
}
