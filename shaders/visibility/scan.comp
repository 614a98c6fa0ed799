// Exclusive prefix sums of blocks of kScanBlock numbers, in place.
//
// First dispatch: one workgroup per block of entries, which also writes the block's total. Second dispatch, with
// JAL_SCAN_SUMS: one workgroup sums up the totals, kScanBlock of them per round, and carries the sum from round to
// round; up to 2^20 entries take one round. The sums are integers: the order of additions does not matter.
// Barrier owed: SHADER_STORAGE. CPU twin: src/visibility/draw_lists_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"
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

/// Replaces the numbers of a block by the carry plus the sums of the numbers before them.
/// @return  sum of the block's numbers, the same in every thread
uint scanBlock(uint block, uint carry) {
  uint lane = gl_LocalInvocationID.x;
  uint first = block * kScanBlock + lane * kScanEntriesPerThread;
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
  uint running = carry + sums[lane] - total;
  for (uint k = 0u; k < kScanEntriesPerThread; ++k) {
    setNumber(first + k, running);
    running += own[k];
  }
  return sums[kScanGroupSize - 1u];
}

void main() {
#ifdef JAL_SCAN_SUMS
  uint carry = 0u;
  for (uint block = 0u; block * kScanBlock < numberCount(); ++block) {
    carry += scanBlock(block, carry);
    barrier();  // the next round overwrites sums
  }
#else
  uint block = groupNumber();
  if (block * kScanBlock >= listView.entryCount) return;
  uint total = scanBlock(block, 0u);
  if (gl_LocalInvocationID.x == 0u) blockSums[block] = total;
#endif
}
