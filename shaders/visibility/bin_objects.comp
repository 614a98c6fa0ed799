// First step of a draw list: how many instances of every bin each tile of objects holds, and each object's rank among
// those of its tile (docs/two_phase_culling.md, "Ordered lists"). Atomics only count; the order is the objects' own.
// Where the scene has cells, the objects here are the cells.
// An object in a cross-fade has a second instance at the level that fades out; the second instances of a tile follow
// all its first ones.
//
// One workgroup: one tile; JAL_TILE_PER_THREAD: one thread. Reads tiles, chains, states, marks. Writes slots, entries.
// Barrier owed: SHADER_STORAGE for scan.comp and scatter.comp. CPU twin: src/visibility/draw_lists_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"
#include "lib/list_buffers.glsl"
#include "lib/fading.glsl"
#include "lib/bins.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std430, binding = kBindingTiles) readonly buffer TileBlock { Tile tiles[]; };
layout(std430, binding = kBindingSlots) writeonly buffer SlotBlock { uint slots[]; };
layout(std430, binding = kBindingStates) readonly buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingMarks) readonly buffer MarkBlock { uint marks[]; };

/// The occlusion pass has its own budget; with two phases the first one draws into the frame itself.
bool drawsOcclusionMap() { return listView.phase == kMarkEarly && !hasTrait(kTraitTwoPhases); }

uint binOf(uint id) {
  uint mark = marks[id];
  return (mark & listView.phase) == 0u ? kNoBin : binOfLevel(states[id], mark, drawsOcclusionMap());
}

/// Bin of the level that fades out.
uint fadingBinOf(uint id) {
  uint mark = marks[id];
  bool fades = (mark & listView.phase) != 0u && hasFadingLevel(mark, drawsOcclusionMap());
  return fades ? fadingBinOfLevel(states[id], mark) : kNoBin;
}

uint slotOf(uint bin, uint rank) { return bin == kNoBin ? kNoBin : (rank << kSlotBinBits) | bin; }

#ifdef JAL_TILE_PER_THREAD

void main() {
  if (threadNumber() >= listView.tileCount) return;
  Tile tile = tiles[threadNumber()];
  Chain chain = chains[tile.chain];
  uint countOfBin[kMaxBinsPerChain];
  for (uint bin = 0u; bin < chain.binCount; ++bin) countOfBin[bin] = 0u;
  for (uint fading = 0u; fading < 2u; ++fading) {
    for (uint id = tile.firstObject; id < tile.firstObject + tile.objectCount; ++id) {
      uint bin = fading != 0u ? fadingBinOf(id) : binOf(id);
      slots[2u * id + fading] = slotOf(bin, bin == kNoBin ? 0u : countOfBin[bin]++);
    }
  }
  for (uint bin = 0u; bin < chain.binCount; ++bin)
    entries[entryIndex(chain, bin, tile.tileOfChain)] = countOfBin[bin];
}

#else

shared uint binOfLane[kObjectGroupSize];
shared uint fadingBinOfLane[kObjectGroupSize];
shared uint countOfBin[kMaxBinsPerChain];
shared uint members;
shared uint fadingMembers;

void main() {
  if (groupNumber() >= listView.tileCount) return;
  Tile tile = tiles[groupNumber()];
  Chain chain = chains[tile.chain];
  uint lane = gl_LocalInvocationID.x;
  uint id = tile.firstObject + lane;
  bool exists = lane < tile.objectCount;
  uint bin = exists ? binOf(id) : kNoBin;
  uint fadingBin = exists ? fadingBinOf(id) : kNoBin;
  binOfLane[lane] = bin;
  fadingBinOfLane[lane] = fadingBin;
  countOfBin[lane] = 0u;
  if (lane == 0u) members = fadingMembers = 0u;
  barrier();
  if (bin != kNoBin) {
    atomicAdd(countOfBin[bin], 1u);
    atomicAdd(members, 1u);
  }
  barrier();
  uint fadingRank = fadingBin != kNoBin ? countOfBin[fadingBin] : 0u;
  barrier();
  if (fadingBin != kNoBin) {
    atomicAdd(countOfBin[fadingBin], 1u);
    atomicAdd(fadingMembers, 1u);
  }
  barrier();

  uint rank = 0u;
  if (members > 0u) {  // most tiles of the second phase are empty
    for (uint other = 0u; other < lane; ++other) rank += binOfLane[other] == bin ? 1u : 0u;
  }
  if (fadingMembers > 0u) {
    for (uint other = 0u; other < lane; ++other) fadingRank += fadingBinOfLane[other] == fadingBin ? 1u : 0u;
  }
  if (exists) {
    slots[2u * id] = slotOf(bin, rank);
    slots[2u * id + 1u] = slotOf(fadingBin, fadingRank);
  }
  if (lane < chain.binCount) entries[entryIndex(chain, lane, tile.tileOfChain)] = countOfBin[lane];
}
#endif
