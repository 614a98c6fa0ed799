// Empties the commands of what a query found hidden, without the CPU having seen the answer (GL_QUERY_BUFFER).
//
// One workgroup: one range. Reads ranges, samples. Writes commands. Barrier owed: COMMAND.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/query_structs.h"
#include "lib/groups.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingSliceView) uniform SliceViewBlock { SliceView sliceView; };
layout(std430, binding = kBindingRanges) readonly buffer RangeBlock { SliceRange ranges[]; };
layout(std430, binding = kBindingSamples) readonly buffer SampleBlock { uint samples[]; };
layout(std430, binding = kBindingCommands) writeonly buffer CommandBlock { DrawCommand commands[]; };

void main() {
  SliceRange range = ranges[groupNumber()];
  if (samples[range.node] > sliceView.threshold) return;
  for (uint unit = gl_LocalInvocationID.x; unit < range.unitCount; unit += kObjectGroupSize) {
    for (uint list = 0u; list < sliceView.listCount; ++list) {
      uint place = list * sliceView.commandCapacity + range.firstUnit + unit;
      commands[place] = DrawCommand(0u, 0u, 0u, 0, 0u);
      commands[place + sliceView.unitCount] = DrawCommand(0u, 0u, 0u, 0, 0u);
    }
  }
}
