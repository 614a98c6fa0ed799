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
  bool facesCulled = sliceView.faceCommands > 0u;  // slice_faces.comp has written two lists
  uint each = max(sliceView.faceCommands, 1u);
  uint lists = facesCulled ? kListSheet + 1u : sliceView.listCount;
  for (uint i = gl_LocalInvocationID.x; i < range.unitCount * each; i += kObjectGroupSize) {
    for (uint list = 0u; list < lists; ++list) {
      uint at = (list * sliceView.commandCapacity + range.firstUnit) * each + i;
      commands[at] = DrawCommand(0u, 0u, 0u, 0, 0u);
      commands[at + sliceView.unitCount * each] = DrawCommand(0u, 0u, 0u, 0, 0u);
    }
  }
}
