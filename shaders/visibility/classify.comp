// Frustum culling and occluder selection; writes the commands of the occlusion pass (thesis 3.2, 4.1.2).
//
// One thread: one object. Reads objects, chains, lods. Writes states (verdict), rects, commands.
// Barrier owed: COMMAND for the occluder draw, SHADER_STORAGE for analyse.comp and emit_commands.comp.
// CPU twin: src/visibility/classify_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/transform.glsl"
#include "lib/frustum.glsl"
#include "lib/buffers.glsl"
#include "lib/commands.glsl"

layout(local_size_x = kObjectGroupSize) in;

uint classify(BoxOnScreen box) {
  if (cullView.cullMode == kCullNone) return kVerdictPending;
  if (box.outside) return kVerdictOutside;
  if (cullView.cullMode == kCullHom &&
      distanceToBox(cullView.cameraWorld.xyz, box.minWorld, box.maxWorld) < cullView.occluderDistance)
    return kVerdictOccluder;
  return box.crossesNear ? kVerdictNear : kVerdictPending;
}

void main() {
  uint id = gl_GlobalInvocationID.x;
  if (id >= cullView.objectCount) return;
  Object object = objects[id];
  Chain chain = chains[object.chain];
  BoxOnScreen box = boxOnScreen(object.worldFromObject0, object.worldFromObject1, object.worldFromObject2,
                                chain.boundsMinObject.xyz, chain.boundsMaxObject.xyz, cullView.clipFromWorld,
                                vec2(cullView.viewportWidth, cullView.viewportHeight));
  uint verdict = classify(box);
  states[id] = ObjectState(verdict, 0u, cullView.maxTessellation, -1.0);
  bool hasRect = !box.outside && !box.crossesNear;
  rects[id] = hasRect ? ScreenRect(box.rect.x, box.rect.y, box.rect.z, box.rect.w) : ScreenRect(0.0, 0.0, 0.0, 0.0);
  if (cullView.cullMode == kCullHom)
    writeCommands(id, object, chain, verdict == kVerdictOccluder, 0u, cullView.maxTessellation);
}
