// Frustum culling, size on screen, occluder selection, and the first choice of detail (thesis 3.2, 4.1.2).
//
// One thread: one object. Reads transforms, objects, chains, lods, and from the last frame marks, states and
// pixelCounts.
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
/// Pixels that showed each object when they were last counted (kTraitLvPixels).
layout(std430, binding = kBindingPixelCounts) readonly buffer PixelCountBlock { uint pixelCounts[]; };

uint classify(BoxOnScreen box, float importance) {
  if (!hasTrait(kTraitCulls)) return kVerdictPending;
  if (box.outside) return kVerdictOutside;
  if (box.crossesNear && !hasTrait(kTraitUsesMap)) return kVerdictNear;
  vec2 size = box.rect.zw - box.rect.xy;
  if (!box.crossesNear && size.x * size.y * importance < cullView.minPixels) return kVerdictSmall;
  if (hasTrait(kTraitUsesMap) &&
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
  if (hasTrait(kTraitTwoPhases)) {
    if (verdict == kVerdictNear) return kMarkEarly | kMarkVisible | kMarkTested;
    return expectedVisible ? kMarkEarly | kMarkVisible | kMarkTested : kMarkTested;
  }
  if (verdict == kVerdictOccluder) return kMarkEarly | kMarkLate | kMarkVisible;
  return verdict == kVerdictPending && hasTrait(kTraitUsesMap) ? 0u : kMarkLate | kMarkVisible;
}

vec4 wholeScreen() { return vec4(0.0, 0.0, cullView.viewportWidth, cullView.viewportHeight); }

/// Whether the detail of what is tested follows from a block that only analyse.comp looks at.
bool followsBlock() {
  return hasTrait(kTraitFollowsLv) && !hasTrait(kTraitLvPixels);
}

/// Whether pixelCounts say something about an object: not if it came into the picture after they were made.
bool isCounted(uint lastMarks) {
  bool drawn = (lastMarks & (kMarkEarly | kMarkLate)) != 0u;
  return hasTrait(kTraitLvPixels) && drawn && (cullView.countsValid != 0u || (lastMarks & kMarkCounted) != 0u);
}

/// What is known of an object's visibility before this frame's test.
/// @param history  whether the last frame left an LV   @param remembered  whether to go on from it calmly
/// @param measured  whether it came from a count
float lvBeforeTest(uint id, uint verdict, bool history, bool remembered, bool measured, bool counted,
                   bool measuredLater, vec4 rect, ObjectState last) {
  if (!history) return -1.0;
  if (counted) {
    vec2 size = rect.zw - rect.xy;
    float lv = pixelsLv(float(pixelCounts[id]), size.x * size.y);
    return measured ? smoothLv(last.lv, lv) : lv;
  }
  if (remembered && hasTrait(kTraitLvPixels)) {
    bool inView = verdict != kVerdictOutside && verdict != kVerdictSmall;
    return inView ? last.lv : forgottenLv(last.lv);
  }
  return measuredLater && hasTrait(kTraitTwoPhases) ? last.lv : -1.0;
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
  boxes[id] = ScreenBox(rect.x, rect.y, rect.z, rect.w, box.nearestDepth, pixelsPerUnit, tau, kCoverOpen);

  uint verdict = classify(box, importance);
  uint lastMarks = marks[id];
  ObjectState last = states[id];
  bool known = (lastMarks & (kMarkEarly | kMarkLate)) != 0u;
  bool counted = isCounted(lastMarks);
  bool remembered = cullView.calm != 0u && (lastMarks & kMarkCalm) != 0u;
  bool measured = remembered && (lastMarks & kMarkMeasured) != 0u;
  uint mark = phasesOf(verdict, isExpectedVisible(lastMarks, rect)) | (isMirrored(transform) ? kMarkMirrored : 0u) |
              (known ? kMarkKnown | (lastMarks & kMarkFadeMask) : 0u) | (counted ? kMarkCounted : 0u) |
              (cullView.calm != 0u ? kMarkCalm : 0u) | (remembered ? kMarkRemembered : 0u) |
              (cullView.calm != 0u && (counted || measured) ? kMarkMeasured : 0u);
  bool measuredLater = verdict == kVerdictPending && hasTrait(kTraitTestsOcclusion);
  bool history = known || remembered;
  ObjectState state = ObjectState(verdict, 0u, cullView.maxTessellation,
                                  lvBeforeTest(id, verdict, history, remembered, measured, counted, measuredLater,
                                               hasRect ? rect : wholeScreen(), last));
  if (measuredLater && history && hasTrait(kTraitUsesMap) && followsBlock()) {
    state = ObjectState(verdict, last.lod, last.tessellation, last.lv);  // analyse.comp goes on from here
  } else {
    bool seen = known && (!counted || pixelCounts[id] > 0u);
    chooseDetail(chain, pixelsPerUnit, tau, seen, last, state, mark);
  }
  marks[id] = mark;
  states[id] = state;
}
