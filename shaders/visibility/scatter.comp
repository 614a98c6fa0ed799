// Writes every object of a phase to its place in the instance list, and the levels that fade out to theirs. The slot of
// an instance behind the list's capacity becomes kNoBin, so that count_states.comp counts what is drawn.
//
// JAL_PER_OBJECT: the reference path writes one command per instance as well, in the same order.
// One workgroup: one tile; JAL_TILE_PER_THREAD: one thread. Reads tiles, chains, slots, entries, blockSums. Writes
// instances, slots (and commands).
// Barrier owed: VERTEX_ATTRIB_ARRAY, SHADER_STORAGE, COMMAND. CPU twin: src/visibility/draw_lists_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"
#include "lib/list_buffers.glsl"
#include "lib/offsets.glsl"
#ifdef JAL_PER_OBJECT
#include "lib/commands.glsl"
#endif

layout(local_size_x = kObjectGroupSize) in;
layout(std430, binding = kBindingTiles) readonly buffer TileBlock { Tile tiles[]; };
layout(std430, binding = kBindingSlots) buffer SlotBlock { uint slots[]; };
layout(std430, binding = kBindingInstances) writeonly buffer InstanceBlock { uint instances[]; };

/// @param number  of the slot, which says where in its tile and in which bin   @param entry  of the instance list
void place(Tile tile, uint number, uint entry) {
  uint slot = slots[number];
  if (slot == kNoBin) return;
  uint bin = slot & ((1u << kSlotBinBits) - 1u);
  Chain chain = chains[tile.chain];
  uint index = offsetOf(entryIndex(chain, bin, tile.tileOfChain)) + (slot >> kSlotBinBits);
  if (index >= listView.capacity) {
    slots[number] = kNoBin;
    return;
  }
  instances[index] = entry;
#ifdef JAL_PER_OBJECT
  Ranges ranges = rangesOf(chain, bin);
  for (uint k = 0u; k < kListsPerDetail; ++k)
    commands[(ranges.firstList + k) * listView.commandCapacity + index] = DrawCommand(
        ranges.count[k], ranges.count[k] > 0u ? 1u : 0u, ranges.firstIndex[k], ranges.baseVertex, index);
#endif
}

void placeBoth(Tile tile, uint id) {
  place(tile, 2u * id, slots[2u * id + 1u] == kNoBin ? id : id | kInstanceFadingIn);
  place(tile, 2u * id + 1u, id | kInstanceFadingOut);
}

void main() {
#ifdef JAL_TILE_PER_THREAD
  if (threadNumber() >= listView.tileCount) return;
  Tile tile = tiles[threadNumber()];
  for (uint k = 0u; k < tile.objectCount; ++k) placeBoth(tile, tile.firstObject + k);
#else
  if (groupNumber() >= listView.tileCount) return;
  Tile tile = tiles[groupNumber()];
  if (gl_LocalInvocationID.x < tile.objectCount) placeBoth(tile, tile.firstObject + gl_LocalInvocationID.x);
#endif
}
