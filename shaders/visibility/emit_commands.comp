// LV -> detail -> draw commands (thesis 3.5, 4.1.1, 4.1.3).
//
// One thread: one object. Reads states, objects, chains, lods. Writes states (lod, tessellation), commands.
// Barrier owed: COMMAND for the draw, SHADER_STORAGE for the shaders that read states.
// CPU twin: src/visibility/commands_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/buffers.glsl"
#include "lib/commands.glsl"
#include "lib/lod.glsl"

layout(local_size_x = kObjectGroupSize) in;

void main() {
  uint id = gl_GlobalInvocationID.x;
  if (id >= cullView.objectCount) return;
  Object object = objects[id];
  Chain chain = chains[object.chain];
  ObjectState state = states[id];
  bool drawn = state.verdict != kVerdictOutside && state.verdict != kVerdictOccluded;
  if (cullView.lodRule == kLodLinear && state.verdict == kVerdictPartial) {
    state.lod = linearLod(state.lv, chain.lodCount);
    state.tessellation = tessellationLevel(state.lv, cullView.maxTessellation);
  }
  states[id] = state;
  writeCommands(id, object, chain, drawn, state.lod, state.tessellation);
}
