// After a frame drawn in slices: the marks of what the queries found hidden. An object stays marked if its slice was
// drawn, or was drawn where its leaf's samples passed.
//
// One thread: one place of the hierarchy's order. Reads order, drawnBits, leafOf, samples. Writes states, marks.
// Barrier owed: SHADER_STORAGE. CPU twin: src/visibility/slice_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/frame_structs.h"
#include "shared/query_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingSliceView) uniform SliceViewBlock { SliceView sliceView; };
layout(std430, binding = kBindingOrder) readonly buffer OrderBlock { uint order[]; };
layout(std430, binding = kBindingDrawnBits) readonly buffer DrawnBitBlock { uint drawnBits[]; };
layout(std430, binding = kBindingLeafOf) readonly buffer LeafBlock { uint leafOf[]; };
layout(std430, binding = kBindingSamples) readonly buffer SampleBlock { uint samples[]; };
layout(std430, binding = kBindingStates) buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingMarks) buffer MarkBlock { uint marks[]; };

void main() {
  uint place = threadNumber();
  if (place >= sliceView.objectCount) return;
  uint id = order[place];
  bool drawn = (drawnBits[place >> 5u] >> (place & 31u) & 1u) != 0u && samples[leafOf[place]] > sliceView.threshold;
  if (drawn || (marks[id] & kMarkLate) == 0u) return;
  marks[id] &= ~(kMarkLate | kMarkVisible);
  states[id].verdict = kVerdictOccluded;
}
