// Counts the visible pixels of each object in the item buffer (docs/level_of_visibility.md). Whole numbers, so the
// order in which atomics add them does not matter.
//
// One thread: one block of kCountBlockWidth x kCountBlockHeight pixels; a run of pixels of one object is added at once,
// and the pixels of the workgroup's first object once per workgroup.
// Reads the item buffer. Adds to pixelCounts, which the frame cleared. Barrier owed: SHADER_STORAGE for the next
// frame's classify.comp. CPU twin: src/visibility/item_buffer.cpp
#version 450 core
#include "shared/limits.h"

layout(local_size_x = kTexelGroupSide, local_size_y = kTexelGroupSide) in;
layout(r32ui, binding = kImageSource) readonly uniform uimage2D items;  // object index + 1, 0: nothing
layout(std430, binding = kBindingPixelCounts) buffer PixelCountBlock { uint pixelCounts[]; };

shared uint firstItem;
shared uint firstCount;

void add(uint item, uint count) {
  if (item == 0u) return;
  if (item == firstItem) {
    atomicAdd(firstCount, count);
  } else {
    atomicAdd(pixelCounts[item - 1u], count);
  }
}

void main() {
  ivec2 size = imageSize(items);
  ivec2 first = ivec2(gl_GlobalInvocationID.xy) * ivec2(kCountBlockWidth, kCountBlockHeight);
  if (gl_LocalInvocationIndex == 0u) {
    firstItem = imageLoad(items, min(first, size - 1)).r;
    firstCount = 0u;
  }
  barrier();
  ivec2 end = min(first + ivec2(kCountBlockWidth, kCountBlockHeight), size);
  uint item = 0u, run = 0u;
  for (int y = first.y; y < end.y; ++y) {
    for (int x = first.x; x < end.x; ++x) {
      uint here = imageLoad(items, ivec2(x, y)).r;
      if (here != item) {
        add(item, run);
        item = here;
        run = 0u;
      }
      ++run;
    }
  }
  if (run > 0u) add(item, run);
  barrier();
  if (gl_LocalInvocationIndex == 0u && firstCount > 0u) atomicAdd(pixelCounts[firstItem - 1u], firstCount);
}
