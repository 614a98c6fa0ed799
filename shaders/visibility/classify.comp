// Frustum culling, size on screen, occluder selection, and the first choice of detail (thesis 3.2, 4.1.2).
//
// One thread: one object. Reads transforms, objects, chains, lods; and marks, states, pixelCounts and
// ScreenBox.cover of the last frame.
// Writes states, boxes, marks. Barrier owed: SHADER_STORAGE for analyse.comp and bin_objects.comp.
// CPU twin: src/visibility/classify_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"
#include "lib/transform.glsl"
#include "lib/frustum.glsl"
#include "lib/overlap.glsl"
#include "lib/buffers.glsl"
#include "lib/importance.glsl"
#include "lib/lod.glsl"
#include "lib/expectation.glsl"

layout(local_size_x = kObjectGroupSize) in;
/// Visible pixels of each object when they were last counted (kTraitLvPixels).
layout(std430, binding = kBindingPixelCounts) readonly buffer PixelCountBlock { uint pixelCounts[]; };

/// Verdict of one box before the overlap test. @param importance  in (0, 1]; scales the pixels it counts for
uint classify(BoxOnScreen box, float importance) {
  if (!hasTrait(kTraitCulls)) return kVerdictPending;
  if (box.outside) return kVerdictOutside;
  if (box.crossesNear && !hasTrait(kTraitUsesMap)) return kVerdictNear;
  vec2 size = box.rect.zw - box.rect.xy;
  if (!box.crossesNear && size.x * size.y * importance < cullView.minPixels) return kVerdictSmall;
  if (cullView.minSpherePixels > 0.0 &&
      sphereArea(cullView.cameraWorld.xyz, cullView.forwardWorld, cullView.focalPixels, box) * importance <
          cullView.minSpherePixels)
    return kVerdictSmall;
  if (hasTrait(kTraitUsesMap) &&
      distanceFromEye(cullView.cameraWorld, cullView.forwardWorld, box.minWorld, box.maxWorld) <
          cullView.occluderDistance)
    return kVerdictOccluder;
  return box.crossesNear ? kVerdictNear : kVerdictPending;
}

/// Flags that the verdict alone decides; analyse.comp adds the others.
uint phasesOf(uint verdict, bool expectedVisible) {
  if (verdict == kVerdictOutside || verdict == kVerdictSmall) return 0u;
  if (hasTrait(kTraitTwoPhases)) {
    bool early = verdict == kVerdictNear || expectedVisible;
    return early ? kMarkEarly | kMarkVisible | kMarkTested : kMarkTested;
  }
  if (verdict == kVerdictOccluder) return kMarkEarly | kMarkLate | kMarkVisible;
  return verdict == kVerdictPending && hasTrait(kTraitUsesMap) ? 0u : kMarkLate | kMarkVisible;
}

/// What earlier frames left of an object.
struct History {
  ObjectState state;  // of the last frame
  uint marks;         // of the last frame
  uint pixels;        // visible ones, with counted
  bool known;         // it was drawn in the last frame
  bool remembered;    // the last frame was calm, and so is this one: LV is smoothed from its last value
  bool measured;      // the remembered LV comes from a count
  bool counted;       // pixels is valid: the object has been drawn ever since the count
};

History historyOf(uint id) {
  History history;
  history.state = states[id];
  history.marks = marks[id];
  history.known = (history.marks & (kMarkEarly | kMarkLate)) != 0u;
  history.remembered = cullView.calm != 0u && (history.marks & kMarkCalm) != 0u;
  history.measured = history.remembered && (history.marks & kMarkMeasured) != 0u;
  history.counted = hasTrait(kTraitLvPixels) && history.known &&
                    (cullView.countsValid != 0u || (history.marks & kMarkCounted) != 0u);
  history.pixels = 0u;
  if (history.counted) history.pixels = pixelCounts[id];
  return history;
}

/// Flags that pass the history on.
uint marksOf(History history) {
  bool calm = cullView.calm != 0u;
  return (history.known ? kMarkKnown | (history.marks & kMarkFadeMask) : 0u) | (history.counted ? kMarkCounted : 0u) |
         (calm ? kMarkCalm : 0u) | (history.remembered ? kMarkRemembered : 0u) |
         (calm && (history.counted || history.measured) ? kMarkMeasured : 0u) |
         (history.counted && history.pixels == 0u ? kMarkUnseen : 0u);
}

/// Whether analyse.comp will test the object.
bool isTestedLater(uint verdict) { return verdict == kVerdictPending && hasTrait(kTraitTestsOcclusion); }

/// LV from what is known before this frame's test. @param area  as DetailInput
float lvBeforeTest(History history, uint verdict, float area) {
  if (!history.known && !history.remembered) return -1.0;
  if (history.counted) {
    float lv = pixelsLv(float(history.pixels), area);
    return history.measured ? smoothLv(history.state.lv, lv) : lv;
  }
  if (history.remembered && hasTrait(kTraitLvPixels)) {
    bool inView = verdict != kVerdictOutside && verdict != kVerdictSmall;
    return inView ? history.state.lv : forgottenLv(history.state.lv);
  }
  return isTestedLater(verdict) && hasTrait(kTraitTwoPhases) ? history.state.lv : -1.0;
}

/// Whether LV follows from a block that only analyse.comp looks at.
bool lvWaitsForBlock() { return hasTrait(kTraitFollowsLv) && !hasTrait(kTraitLvPixels) && hasTrait(kTraitUsesMap); }

/// Whether the detail follows from a block that only analyse.comp looks at: until then it stays as it was.
bool waitsForBlock(History history, uint verdict, bool early) {
  bool masks = hasTrait(kTraitMasksError) && !early && !history.counted;
  bool followsBlock = lvWaitsForBlock() || masks;
  return isTestedLater(verdict) && (history.known || history.remembered) && followsBlock;
}

/// The cover that masks the errors of an object that does not wait for its block: the last one measured.
uint coverBeforeTest(History history, uint verdict, uint id) {
  if (hasTrait(kTraitMasksError) && history.known && isTestedLater(verdict)) return boxes[id].cover;
  return kCoverOpen;
}

/// @param rect  pixels, clipped; 0 if there is no rectangle
ScreenBox screenBoxOf(BoxOnScreen box, vec4 rect, float scale, float importance) {
  float nearest = distanceToBox(cullView.cameraWorld.xyz, box.minWorld, box.maxWorld);
  float pixelsPerUnit = cullView.forwardWorld.w == 0.0
                            ? projectedScale(scale, cullView.focalPixels, nearest, cullView.cameraWorld.w)
                            : scale * cullView.focalPixels;
  return ScreenBox(rect.x, rect.y, rect.z, rect.w, box.nearestDepth, pixelsPerUnit, cullView.tau / importance,
                   kCoverOpen);
}

/// Flags of the level that an occluder has in the occlusion map, which has its own budget.
uint mapLodMark(Chain chain, float pixelsPerUnit) {
  if (!hasTrait(kTraitUsesMap)) return 0u;
  return pixelErrorLod(chain, pixelsPerUnit, cullView.occluderTau) << kMarkMapLodShift;
}

void main() {
  uint id = threadNumber();
  if (id >= cullView.objectCount) return;
  Object object = objects[id];
  Transform transform = transforms[object.transform];
  Chain chain = chains[object.chain];
  vec2 viewport = vec2(cullView.viewportWidth, cullView.viewportHeight);
  BoxOnScreen box = boxOnScreen(transform, chain.boundsMinObject.xyz, chain.boundsMaxObject.xyz, cullView.clipFromWorld,
                                viewport);
  bool hasRect = !box.outside && !box.crossesNear;
  vec4 rect = hasRect ? box.rect : vec4(0.0);
  float importance = hasRect ? importanceOf(rect) : 1.0;
  ScreenBox screen = screenBoxOf(box, rect, largestScale(transform), importance);

  uint verdict = classify(box, importance);
  History history = historyOf(id);
  uint mark = phasesOf(verdict, isExpectedVisible(history.marks, rect)) | (isMirrored(transform) ? kMarkMirrored : 0u) |
              marksOf(history) | mapLodMark(chain, screen.pixelsPerUnit);
  if ((mark & (kMarkTested | kMarkEarly)) == kMarkTested && (history.marks & kMarkTested) == 0u) mark |= kMarkNew;
  screen.cover = coverBeforeTest(history, verdict, id);
  vec2 size = box.crossesNear && !box.outside ? viewport : rect.zw - rect.xy;
  float area = size.x * size.y;
  float lv = lvBeforeTest(history, verdict, area);
  ObjectState state = ObjectState(verdict, 0u, cullView.maxTessellation, lv);
  if (waitsForBlock(history, verdict, (mark & kMarkEarly) != 0u)) {
    state = ObjectState(verdict, history.state.lod, history.state.tessellation,
                        lvWaitsForBlock() ? history.state.lv : lv);
  } else {
    // A calm level that the budget of the last frame made coarser comes back at once.
    bool limited = history.remembered && (history.marks & kMarkLimited) != 0u;
    bool seen = history.known && (!history.counted || history.pixels > 0u) && !limited;
    chooseDetail(DetailInput(chain, screen.pixelsPerUnit, screen.tau, area, seen, history.state, screen.cover), state,
                 mark);
  }
  boxes[id] = screen;
  marks[id] = mark;
  states[id] = state;
}
