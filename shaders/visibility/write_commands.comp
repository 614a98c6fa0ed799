// The instanced commands of a draw list: one per bin that has instances and triangles, moved together without gaps, and
// empty ones behind them for drivers that cannot take the number of draws from a buffer.
//
// JAL_PER_OBJECT: the commands exist already; only the counts are written.
// One workgroup for all bins. Reads bins, chains, lods, entries, blockSums. Writes commands, drawCounts.
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
layout(std430, binding = kBindingDrawCounts) writeonly buffer DrawCountBlock { uint drawCounts[]; };

void writeTotals() {
  uint total = totalInstances();
  uint kept = min(total, listView.capacity);
  drawCounts[kCountInstances] = kept;
  drawCounts[kCountDropped] = total - kept;
}

#ifdef JAL_PER_OBJECT
void main() {
  if (gl_LocalInvocationID.x != 0u) return;
  writeTotals();
  uint kept = min(totalInstances(), listView.capacity);
  for (uint list = 0u; list < kListCount; ++list)
    drawCounts[list] = list < kListsPerDetail || listView.patches != 0u ? kept : 0u;
}
#else

/// Commands per list up to and including each lane, three lists of nine bits in x, the three of the patches in y.
shared uvec2 sums[kScanGroupSize];

uint countIn(uvec2 flags, uint list) {
  return ((list < kListsPerDetail ? flags.x : flags.y) >> (10u * (list % kListsPerDetail))) & 1023u;
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint written[kListCount];
  for (uint list = 0u; list < kListCount; ++list) written[list] = 0u;
  for (uint start = 0u; start < listView.binCount; start += kScanGroupSize) {
    uint index = start + lane;
    uvec2 own = uvec2(0u);
    Ranges ranges;
    uint first = 0u, instanceCount = 0u;
    if (index < listView.binCount) {
      Bin bin = bins[index];
      Chain chain = chains[bin.chain];
      uint entry = entryIndex(chain, bin.bin, 0u);
      first = min(offsetOf(entry), listView.capacity);
      instanceCount = min(offsetOf(entry + chain.tileCount), listView.capacity) - first;
      ranges = rangesOf(chain, bin.bin);
      uint flags = 0u;
      for (uint k = 0u; k < kListsPerDetail; ++k)
        flags |= (instanceCount > 0u && ranges.count[k] > 0u ? 1u : 0u) << (10u * k);
      own = ranges.firstList == kListSolid ? uvec2(flags, 0u) : uvec2(0u, flags);
    }
    sums[lane] = own;
    barrier();
    for (uint reach = 1u; reach < kScanGroupSize; reach <<= 1u) {
      uvec2 before = lane >= reach ? sums[lane - reach] : uvec2(0u);
      barrier();
      sums[lane] += before;
      barrier();
    }
    uvec2 place = sums[lane] - own;
    uvec2 total = sums[kScanGroupSize - 1u];
    for (uint k = 0u; k < kListsPerDetail; ++k) {
      uint list = (own.y != 0u ? kListSolidPatch : kListSolid) + k;
      if (countIn(own, list) == 0u) continue;
      commands[list * listView.commandCapacity + written[list] + countIn(place, list)] =
          DrawCommand(ranges.count[k], instanceCount, ranges.firstIndex[k], ranges.baseVertex, first);
    }
    for (uint list = 0u; list < kListCount; ++list) written[list] += countIn(total, list);
    barrier();
  }
  uint lists = listView.patches != 0u ? kListCount : kListsPerDetail;
  for (uint list = 0u; list < lists; ++list) {
    for (uint i = written[list] + lane; i < listView.commandCapacity; i += kScanGroupSize)
      commands[list * listView.commandCapacity + i] = DrawCommand(0u, 0u, 0u, 0, 0u);
  }
  if (lane == 0u) {
    for (uint list = 0u; list < kListCount; ++list) drawCounts[list] = written[list];
    writeTotals();
  }
}
#endif
