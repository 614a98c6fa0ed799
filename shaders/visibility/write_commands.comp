// Writes the instanced commands of a draw list: one per bin that has instances and triangles, compacted. What follows
// them is empty, for drivers that cannot read the number of draws from a buffer: the buffer begins with zeros, and
// commands of the frame before that are not overwritten are cleared.
//
// JAL_PER_OBJECT: the commands exist already; only the counts are written.
// One workgroup for all bins. Reads bins, chains, lods, entries, blockSums, and drawCounts of the frame before. Writes
// commands, drawCounts.
// Barrier owed: COMMAND, and BUFFER_UPDATE for the statistics. CPU twin: src/visibility/draw_lists_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/list_buffers.glsl"
#include "lib/offsets.glsl"
#include "lib/commands.glsl"

layout(local_size_x = kScanGroupSize) in;
layout(std430, binding = kBindingBins) readonly buffer BinBlock { Bin bins[]; };
layout(std430, binding = kBindingDrawCounts) buffer DrawCountBlock { uint drawCounts[]; };

uint keptInstances() { return min(totalInstances(), listView.capacity); }

#ifdef JAL_PER_OBJECT
void main() {
  if (gl_LocalInvocationID.x != 0u) return;
  uint kept = keptInstances();
  drawCounts[kCountInstances] = kept;
  for (uint list = 0u; list < kListCount; ++list)
    drawCounts[list] = list < kListsPerDetail || listView.patches != 0u ? kept : 0u;
}
#else

/// Commands per list up to and including each lane: three lists of ten bits in x, the three of the patches in y.
shared uvec2 sums[kScanGroupSize];

uint countIn(uvec2 flags, uint list) {
  return ((list < kListsPerDetail ? flags.x : flags.y) >> (10u * (list % kListsPerDetail))) & 1023u;
}

/// What one bin draws; nothing if it has no instances.
struct BinDraw {
  Ranges ranges;
  uint first;          // entry of the instance list
  uint instanceCount;
  uvec2 flags;         // one command in each list whose range has triangles, packed as sums
};

/// @param index  of the bin; may lie behind the last one
BinDraw binDrawOf(uint index) {
  BinDraw draw;
  draw.first = draw.instanceCount = 0u;
  draw.flags = uvec2(0u);
  if (index >= listView.binCount) return draw;
  Bin bin = bins[index];
  Chain chain = chains[bin.chain];
  uint entry = entryIndex(chain, bin.bin, 0u);
  draw.first = min(offsetOf(entry), listView.capacity);
  draw.instanceCount = min(offsetOf(entry + chain.tileCount), listView.capacity) - draw.first;
  draw.ranges = rangesOf(chain, bin.bin);
  uint flags = 0u;
  for (uint k = 0u; k < kListsPerDetail; ++k)
    flags |= (draw.instanceCount > 0u && draw.ranges.count[k] > 0u ? 1u : 0u) << (10u * k);
  draw.flags = draw.ranges.firstList == kListSolid ? uvec2(flags, 0u) : uvec2(0u, flags);
  return draw;
}

/// Leaves in sums the inclusive prefix sum over the lanes. Every lane of the workgroup has to call it.
void addUpLanes(uint lane, uvec2 own) {
  sums[lane] = own;
  barrier();
  for (uint reach = 1u; reach < kScanGroupSize; reach <<= 1u) {
    uvec2 before = lane >= reach ? sums[lane - reach] : uvec2(0u);
    barrier();
    sums[lane] += before;
    barrier();
  }
}

/// @param place  commands of the lanes before, packed   @param written  commands of the rounds before, per list
void writeCommands(BinDraw draw, uvec2 place, uint written[kListCount]) {
  for (uint k = 0u; k < kListsPerDetail; ++k) {
    uint list = (draw.flags.y != 0u ? kListSolidPatch : kListSolid) + k;
    if (countIn(draw.flags, list) == 0u) continue;
    commands[list * listView.commandCapacity + written[list] + countIn(place, list)] = DrawCommand(
        draw.ranges.count[k], draw.instanceCount, draw.ranges.firstIndex[k], draw.ranges.baseVertex, draw.first);
  }
}

void clearOldCommands(uint lane, uint written[kListCount]) {
  for (uint list = 0u; list < kListCount; ++list) {
    for (uint i = written[list] + lane; i < drawCounts[list]; i += kScanGroupSize)
      commands[list * listView.commandCapacity + i] = DrawCommand(0u, 0u, 0u, 0, 0u);
  }
}

/// Instances in front of a bin. Bins and their entries have the same order. @param index  may lie behind the last one
uint instancesBefore(uint index) {
  if (index >= listView.binCount) return totalInstances();
  return offsetOf(entryIndex(chains[bins[index].chain], bins[index].bin, 0u));
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint written[kListCount];
  for (uint list = 0u; list < kListCount; ++list) written[list] = 0u;
  for (uint start = 0u; start < listView.binCount; start += kScanGroupSize) {
    if (instancesBefore(start) == instancesBefore(start + kScanGroupSize)) continue;  // the same in all lanes
    BinDraw draw = binDrawOf(start + lane);
    addUpLanes(lane, draw.flags);
    writeCommands(draw, sums[lane] - draw.flags, written);
    uvec2 total = sums[kScanGroupSize - 1u];
    for (uint list = 0u; list < kListCount; ++list) written[list] += countIn(total, list);
    barrier();
  }
  clearOldCommands(lane, written);
  barrier();
  if (lane == 0u) {
    for (uint list = 0u; list < kListCount; ++list) drawCounts[list] = written[list];
    drawCounts[kCountInstances] = keptInstances();
  }
}
#endif
