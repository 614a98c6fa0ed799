// Frustum culling, size on screen, occluder selection, and the first choice of detail (thesis 3.2, 4.1.2).
//
// One thread: one object. Reads transforms, objects, chains, lods, and from the last frame marks and states (lv).
// Writes states, boxes, marks. Barrier owed: SHADER_STORAGE for analyse.comp and bin_objects.comp.
// CPU twin: src/visibility/classify_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/transform.glsl"
#include "lib/frustum.glsl"
#include "lib/overlap.glsl"
#include "lib/buffers.glsl"
#include "lib/importance.glsl"
#include "lib/lod.glsl"

layout(local_size_x = kObjectGroupSize) in;

bool selectsOccluders() { return cullView.cullMode == kCullHom || cullView.cullMode == kCullHomDepth; }

uint classify(BoxOnScreen box, float importance) {
  if (cullView.cullMode == kCullNone) return kVerdictPending;
  if (box.outside) return kVerdictOutside;
  if (box.crossesNear && !selectsOccluders()) return kVerdictNear;
  vec2 size = box.rect.zw - box.rect.xy;
  if (!box.crossesNear && size.x * size.y * importance < cullView.minPixels) return kVerdictSmall;
  if (selectsOccluders() &&
      distanceToBox(cullView.cameraWorld.xyz, box.minWorld, box.maxWorld) < cullView.occluderDistance)
    return kVerdictOccluder;
  return box.crossesNear ? kVerdictNear : kVerdictPending;
}

/// Two phases: what is drawn before the test. What was tested in the last frame is expected to stay as it was; of what is
/// new, the large ones.
bool isExpectedVisible(uint lastMarks, vec4 rect) {
  if ((lastMarks & kMarkTested) != 0u) return (lastMarks & kMarkVisible) != 0u;
  vec2 size = rect.zw - rect.xy;
  return size.x * size.y >= kLargeShare * float(cullView.viewportWidth * cullView.viewportHeight);
}

/// What the verdict alone decides about the phases; analyse.comp adds the rest.
uint phasesOf(uint verdict, bool expectedVisible) {
  bool drawn = verdict != kVerdictOutside && verdict != kVerdictSmall;
  if (!drawn) return 0u;
  if (cullView.cullMode == kCullHiz) {
    if (verdict == kVerdictNear) return kMarkEarly | kMarkVisible | kMarkTested;
    return expectedVisible ? kMarkEarly | kMarkVisible | kMarkTested : kMarkTested;
  }
  if (verdict == kVerdictOccluder) return kMarkEarly | kMarkLate | kMarkVisible;
  return verdict == kVerdictPending && selectsOccluders() ? 0u : kMarkLate | kMarkVisible;
}

void main() {
  uint id = gl_GlobalInvocationID.x;
  if (id >= cullView.objectCount) return;
  Transform transform = transforms[id];
  Chain chain = chains[objects[id].chain];
  BoxOnScreen box = boxOnScreen(transform, chain.boundsMinObject.xyz, chain.boundsMaxObject.xyz, cullView.clipFromWorld,
                                vec2(cullView.viewportWidth, cullView.viewportHeight));
  bool hasRect = !box.outside && !box.crossesNear;
  vec4 rect = hasRect ? box.rect : vec4(0.0);
  float importance = hasRect ? importanceOf(rect) : 1.0;
  float pixelsPerUnit =
      projectedScale(largestScale(transform), cullView.focalPixels,
                     distance(cullView.cameraWorld.xyz, box.centerWorld), box.radiusWorld, cullView.cameraWorld.w);
  float tau = cullView.tau / importance;
  boxes[id] = ScreenBox(rect.x, rect.y, rect.z, rect.w, box.nearestDepth, pixelsPerUnit, tau, 0.0);

  uint verdict = classify(box, importance);
  uint lastMarks = marks[id];
  uint phases = phasesOf(verdict, isExpectedVisible(lastMarks, rect));
  marks[id] = phases | (isMirrored(transform) ? kMarkMirrored : 0u);

  // Two phases: what is drawn before the test has only last frame's level of visibility to go by.
  bool early = cullView.cullMode == kCullHiz && (lastMarks & kMarkVisible) != 0u && verdict == kVerdictPending;
  ObjectState state = ObjectState(verdict, 0u, cullView.maxTessellation, early ? states[id].lv : -1.0);
  chooseDetail(chain, pixelsPerUnit, tau, state);
  states[id] = state;
}
