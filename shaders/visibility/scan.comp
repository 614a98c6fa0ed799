// Exclusive prefix sum of one block of kScanBlock numbers, in place.
//
// First dispatch: one workgroup per block of entries, which also writes the block's total. Second dispatch, with
// JAL_SCAN_SUMS: one workgroup over the totals. Integer sums, so the result does not depend on the order.
// Barrier owed: SHADER_STORAGE. CPU twin: src/visibility/draw_lists_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/list_buffers.glsl"

layout(local_size_x = kScanGroupSize) in;
layout(std430, binding = kBindingBlockSums) buffer BlockSumBlock { uint blockSums[]; };

shared uint sums[kScanGroupSize];

#ifdef JAL_SCAN_SUMS
uint numberCount() { return (listView.entryCount + kScanBlock - 1u) / kScanBlock; }
uint number(uint index) { return index < numberCount() ? blockSums[index] : 0u; }
void setNumber(uint index, uint value) { if (index < numberCount()) blockSums[index] = value; }
#else
uint number(uint index) { return index + 1u < listView.entryCount ? entries[index] : 0u; }  // the last one is a zero
void setNumber(uint index, uint value) { if (index < listView.entryCount) entries[index] = value; }
#endif

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint first = gl_WorkGroupID.x * kScanBlock + lane * kScanEntriesPerThread;
  uint own[kScanEntriesPerThread];
  uint total = 0u;
  for (uint k = 0u; k < kScanEntriesPerThread; ++k) {
    own[k] = number(first + k);
    total += own[k];
  }
  sums[lane] = total;
  barrier();
  for (uint reach = 1u; reach < kScanGroupSize; reach <<= 1u) {
    uint before = lane >= reach ? sums[lane - reach] : 0u;
    barrier();
    sums[lane] += before;
    barrier();
  }
  uint running = sums[lane] - total;
  for (uint k = 0u; k < kScanEntriesPerThread; ++k) {
    setNumber(first + k, running);
    running += own[k];
  }
#ifndef JAL_SCAN_SUMS
  if (lane == kScanGroupSize - 1u) blockSums[gl_WorkGroupID.x] = sums[lane];
#endif
}
