// Frustum culling, screen box and first detail, one object at a time (thesis 3.2, 4.1.2).
#include "visibility/classify_reference.h"

#include <cmath>
#include <limits>

#include "policy/traits.h"
#include "scene/scene_data.h"
#include "shared/limits.h"
#include "visibility/lod_policy.h"

namespace jalousie::visibility {
namespace {

glm::vec3 boxCorner(const Aabb& box, unsigned corner) {
  return {(corner & 1U) != 0 ? box.max.x : box.min.x, (corner & 2U) != 0 ? box.max.y : box.min.y,
          (corner & 4U) != 0 ? box.max.z : box.min.z};
}

glm::vec3 transformPoint(const gpu::Transform& t, const glm::vec3& p) {
  const glm::vec4 h(p, 1.0F);
  return {glm::dot(t.worldFromObject0, h), glm::dot(t.worldFromObject1, h), glm::dot(t.worldFromObject2, h)};
}

/// Largest error of a clip-space component of any point of the box.
glm::vec4 clipRounding(const gpu::Transform& t, const Aabb& box, const glm::mat4& clipFromWorld, float rounding) {
  const glm::vec4 reach(glm::max(glm::abs(box.min), glm::abs(box.max)), 1.0F);
  const glm::vec3 world(glm::dot(glm::abs(t.worldFromObject0), reach), glm::dot(glm::abs(t.worldFromObject1), reach),
                        glm::dot(glm::abs(t.worldFromObject2), reach));
  return rounding * (glm::abs(clipFromWorld[0]) * world.x + glm::abs(clipFromWorld[1]) * world.y +
                     glm::abs(clipFromWorld[2]) * world.z + glm::abs(clipFromWorld[3]));
}

unsigned planesBeyond(const glm::vec4& clip, const glm::vec3& margin) {
  return (clip.x < -clip.w - margin.x ? 1U : 0U) | (clip.x > clip.w + margin.x ? 2U : 0U) |
         (clip.y < -clip.w - margin.y ? 4U : 0U) | (clip.y > clip.w + margin.y ? 8U : 0U) |
         (clip.z < -margin.z ? 16U : 0U) | (clip.z > clip.w + margin.z ? 32U : 0U);
}

/// What earlier frames left of an object.
struct History {
  gpu::ObjectState state;   ///< of the last frame
  gpu::uint marks = 0;      ///< of the last frame
  gpu::uint pixels = 0;     ///< visible ones, with counted
  bool known = false;       ///< it was drawn in the last frame
  bool remembered = false;  ///< the last frame was calm, and so is this one: LV is smoothed from its last value
  bool measured = false;    ///< the remembered LV comes from a count
  bool counted = false;     ///< pixels is valid: the object has been drawn ever since the count
};

History historyOf(const gpu::CullView& view, const LastFrame& last) {
  History history;
  history.state = last.state;
  history.marks = last.marks;
  history.known = (last.marks & (gpu::kMarkEarly | gpu::kMarkLate)) != 0;
  history.remembered = view.calm != 0 && (last.marks & gpu::kMarkCalm) != 0;
  history.measured = history.remembered && (last.marks & gpu::kMarkMeasured) != 0;
  history.counted = has(view.traits, gpu::kTraitLvPixels) && history.known &&
                    (view.countsValid != 0 || (last.marks & gpu::kMarkCounted) != 0);
  if (history.counted) history.pixels = last.pixels;
  return history;
}

/// Flags that pass the history on.
gpu::uint marksOf(const gpu::CullView& view, const History& history) {
  const bool calm = view.calm != 0;
  return (history.known ? gpu::kMarkKnown | (history.marks & gpu::kMarkFadeMask) : 0) |
         (history.counted ? gpu::kMarkCounted : 0) | (calm ? gpu::kMarkCalm : 0) |
         (history.remembered ? gpu::kMarkRemembered : 0) |
         (calm && (history.counted || history.measured) ? gpu::kMarkMeasured : 0) |
         (history.counted && history.pixels == 0 ? gpu::kMarkUnseen : 0);
}

/// Whether analyse.comp will test the object.
bool isTestedLater(const gpu::CullView& view, gpu::uint verdict) {
  return verdict == gpu::kVerdictPending && has(view.traits, gpu::kTraitTestsOcclusion);
}

/// LV from what is known before this frame's test. @param area  as DetailInput
float lvBeforeTest(const gpu::CullView& view, const History& history, gpu::uint verdict, float area) {
  if (!history.known && !history.remembered) return -1.0F;
  if (history.counted) {
    const float lv = pixelsLv(static_cast<float>(history.pixels), area);
    return history.measured ? smoothLv(history.state.lv, lv) : lv;
  }
  if (history.remembered && has(view.traits, gpu::kTraitLvPixels)) {
    const bool inView = verdict != gpu::kVerdictOutside && verdict != gpu::kVerdictSmall;
    return inView ? history.state.lv : forgottenLv(history.state.lv);
  }
  return isTestedLater(view, verdict) && has(view.traits, gpu::kTraitTwoPhases) ? history.state.lv : -1.0F;
}

/// Whether LV follows from a block that only analyse.comp looks at.
bool lvWaitsForBlock(const gpu::CullView& view) {
  return has(view.traits, gpu::kTraitFollowsLv) && !has(view.traits, gpu::kTraitLvPixels) &&
         has(view.traits, gpu::kTraitUsesMap);
}

/// Whether the detail follows from a block that only analyse.comp looks at: until then it stays as it was.
bool waitsForBlock(const gpu::CullView& view, const History& history, gpu::uint verdict, bool early) {
  const bool masks = has(view.traits, gpu::kTraitMasksError) && !early && !history.counted;
  const bool followsBlock = lvWaitsForBlock(view) || masks;
  return isTestedLater(view, verdict) && (history.known || history.remembered) && followsBlock;
}

/// The cover that masks the errors of an object that does not wait for its block: the last one measured.
gpu::uint coverBeforeTest(const gpu::CullView& view, const History& history, gpu::uint verdict, gpu::uint last) {
  const bool masks = has(view.traits, gpu::kTraitMasksError) && history.known && isTestedLater(view, verdict);
  return masks ? last : gpu::kCoverOpen;
}

/// @param rect  pixels, clipped; 0 if there is no rectangle
gpu::ScreenBox screenBoxOf(const gpu::CullView& view, const BoxOnScreen& box, const glm::vec4& rect, float scale,
                           float importance) {
  const float nearest = distanceToBox(glm::vec3(view.cameraWorld), box.boundsWorld);
  const float pixelsPerUnit = view.forwardWorld.w == 0.0F
                                  ? projectedScale(scale, view.focalPixels, nearest, view.cameraWorld.w)
                                  : scale * view.focalPixels;
  return {rect.x, rect.y, rect.z, rect.w, box.nearestDepth, pixelsPerUnit, view.tau / importance, gpu::kCoverOpen};
}

/// Flags of the level that an occluder has in the occlusion map, which has its own budget.
gpu::uint mapLodMark(const scene::SceneData& scene, const gpu::CullView& view, const gpu::Chain& chain,
                     float pixelsPerUnit) {
  if (!has(view.traits, gpu::kTraitUsesMap)) return 0;
  const auto levels = std::span(scene.lods).subspan(chain.firstLod, chain.lodCount);
  return pixelErrorLod(levels, pixelsPerUnit, view.occluderTau) << gpu::kMarkMapLodShift;
}

Aabb boundsOf(const gpu::Chain& chain) {
  return {glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)};
}

}  // namespace

BoxOnScreen boxOnScreen(const gpu::Transform& transform, const Aabb& boundsObject, const glm::mat4& clipFromWorld,
                        const glm::vec2& viewport, float rounding) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  BoxOnScreen result;
  glm::vec2 lowest(kInfinity);
  glm::vec2 highest(-kInfinity);
  unsigned beyondAll = 63;
  const glm::vec4 error = clipRounding(transform, boundsObject, clipFromWorld, rounding);
  const glm::vec3 margin = glm::vec3(error) + error.w;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::vec3 world = transformPoint(transform, boxCorner(boundsObject, corner));
    result.boundsWorld.add(world);
    const glm::vec4 clip = clipFromWorld * glm::vec4(world, 1.0F);
    beyondAll &= planesBeyond(clip, margin);
    const float w = clip.w - error.w;
    if (!(w > 0.0F && clip.z + margin.z < clip.w)) {
      result.crossesNear = true;
      continue;
    }
    const glm::vec2 ndc = glm::vec2(clip) / clip.w;
    const glm::vec2 guard = (glm::vec2(error) + glm::abs(ndc) * error.w) / w * 0.5F * viewport;
    const glm::vec2 pixels = (ndc * 0.5F + 0.5F) * viewport;
    lowest = glm::min(lowest, pixels - guard);
    highest = glm::max(highest, pixels + guard);
    result.nearestDepth = glm::max(result.nearestDepth, (clip.z + error.z) / w);
  }
  result.nearestDepth *= 1.0F + gpu::kDepthSlack;
  result.outside = beyondAll != 0;
  result.rect =
      glm::vec4(glm::clamp(lowest, glm::vec2(0.0F), viewport), glm::clamp(highest, glm::vec2(0.0F), viewport));
  return result;
}

float distanceToBox(const glm::vec3& point, const Aabb& box) {
  return glm::length(glm::max(glm::max(box.min - point, point - box.max), glm::vec3(0.0F)));
}

float largestScale(const gpu::Transform& t) {
  const glm::vec3 x(t.worldFromObject0.x, t.worldFromObject1.x, t.worldFromObject2.x);
  const glm::vec3 y(t.worldFromObject0.y, t.worldFromObject1.y, t.worldFromObject2.y);
  const glm::vec3 z(t.worldFromObject0.z, t.worldFromObject1.z, t.worldFromObject2.z);
  const float xy = std::abs(glm::dot(x, y));
  const float xz = std::abs(glm::dot(x, z));
  const float yz = std::abs(glm::dot(y, z));
  return std::sqrt(glm::max(glm::max(glm::dot(x, x) + xy + xz, glm::dot(y, y) + xy + yz), glm::dot(z, z) + xz + yz));
}

bool isMirrored(const gpu::Transform& t) {
  return glm::dot(glm::vec3(t.worldFromObject0),
                  glm::cross(glm::vec3(t.worldFromObject1), glm::vec3(t.worldFromObject2))) < 0.0F;
}

float distanceFromEye(const gpu::CullView& view, const Aabb& box) {
  const glm::vec3 eye(view.cameraWorld);
  if (view.forwardWorld.w == 0.0F) return distanceToBox(eye, box);
  const glm::vec3 forward(view.forwardWorld);
  const glm::vec3 closest = glm::min(forward * (box.min - eye), forward * (box.max - eye));
  return std::max(closest.x + closest.y + closest.z, 0.0F);
}

float sphereArea(const gpu::CullView& view, const Aabb& box) {
  constexpr float kPi = 3.14159265F;
  const glm::vec3 toCenter = 0.5F * (box.min + box.max) - glm::vec3(view.cameraWorld);
  const float radius = 0.5F * glm::length(box.max - box.min);
  const float size = kPi * (view.focalPixels * radius) * (view.focalPixels * radius);
  if (view.forwardWorld.w != 0.0F) return size;
  const float depth = glm::dot(toCenter, glm::vec3(view.forwardWorld));
  if (depth <= radius) return std::numeric_limits<float>::infinity();
  const float beyond = depth * depth - radius * radius;
  return size * std::sqrt(std::max(glm::dot(toCenter, toCenter) - radius * radius, 0.0F)) /
         (beyond * std::sqrt(beyond));
}

gpu::uint classify(const BoxOnScreen& box, const gpu::CullView& view, float importance) {
  if (!has(view.traits, gpu::kTraitCulls)) return gpu::kVerdictPending;
  if (box.outside) return gpu::kVerdictOutside;
  if (box.crossesNear && !has(view.traits, gpu::kTraitUsesMap)) return gpu::kVerdictNear;
  const glm::vec2 size(box.rect.z - box.rect.x, box.rect.w - box.rect.y);
  if (!box.crossesNear && size.x * size.y * importance < view.minPixels) return gpu::kVerdictSmall;
  if (view.minSpherePixels > 0.0F && sphereArea(view, box.boundsWorld) * importance < view.minSpherePixels)
    return gpu::kVerdictSmall;
  if (has(view.traits, gpu::kTraitUsesMap) && distanceFromEye(view, box.boundsWorld) < view.occluderDistance)
    return gpu::kVerdictOccluder;
  return box.crossesNear ? gpu::kVerdictNear : gpu::kVerdictPending;
}

bool isExpectedVisible(gpu::uint lastMarks, const glm::vec4& rect, const gpu::CullView& view) {
  if ((lastMarks & gpu::kMarkTested) != 0) return (lastMarks & gpu::kMarkVisible) != 0;
  const auto pixels = static_cast<float>(view.viewportWidth * view.viewportHeight);
  return (rect.z - rect.x) * (rect.w - rect.y) >= gpu::kLargeShare * pixels;
}

gpu::uint phasesOf(gpu::uint verdict, bool expectedVisible, gpu::uint traits) {
  if (verdict == gpu::kVerdictOutside || verdict == gpu::kVerdictSmall) return 0;
  if (has(traits, gpu::kTraitTwoPhases)) {
    const bool early = verdict == gpu::kVerdictNear || expectedVisible;
    return early ? gpu::kMarkEarly | gpu::kMarkVisible | gpu::kMarkTested : gpu::kMarkTested;
  }
  if (verdict == gpu::kVerdictOccluder) return gpu::kMarkEarly | gpu::kMarkLate | gpu::kMarkVisible;
  return verdict == gpu::kVerdictPending && has(traits, gpu::kTraitUsesMap) ? 0 : gpu::kMarkLate | gpu::kMarkVisible;
}

ObjectDecision classifyObject(const scene::SceneData& scene, const gpu::CullView& view, gpu::uint objectIndex,
                              const LastFrame& last, const ImportanceMask* importance) {
  const gpu::Object& object = scene.objects[objectIndex];
  const gpu::Transform& transform = scene.transforms[object.transform];
  const gpu::Chain& chain = scene.chains[object.chain];
  const glm::vec2 viewport(view.viewportWidth, view.viewportHeight);
  const BoxOnScreen box = boxOnScreen(transform, boundsOf(chain), view.clipFromWorld, viewport);
  const bool hasRect = !box.outside && !box.crossesNear;
  const glm::vec4 rect = hasRect ? box.rect : glm::vec4(0.0F);
  const float weight =
      hasRect && importance != nullptr ? importance->largestIn(rect, view.viewportWidth, view.viewportHeight) : 1.0F;

  ObjectDecision result;
  result.box = screenBoxOf(view, box, rect, largestScale(transform), weight);
  const gpu::uint verdict = classify(box, view, weight);
  const History history = historyOf(view, last);
  result.marks = phasesOf(verdict, isExpectedVisible(history.marks, rect, view), view.traits) |
                 (isMirrored(transform) ? gpu::kMarkMirrored : 0) | marksOf(view, history) |
                 mapLodMark(scene, view, chain, result.box.pixelsPerUnit);
  const bool waits = (result.marks & (gpu::kMarkTested | gpu::kMarkEarly)) == gpu::kMarkTested;
  if (waits && (history.marks & gpu::kMarkTested) == 0) result.marks |= gpu::kMarkNew;
  result.box.cover = coverBeforeTest(view, history, verdict, last.cover);
  const glm::vec2 size = box.crossesNear && !box.outside ? viewport : glm::vec2(rect.z - rect.x, rect.w - rect.y);
  const float lv = lvBeforeTest(view, history, verdict, size.x * size.y);
  result.state = {verdict, 0, view.maxTessellation, lv};
  if (waitsForBlock(view, history, verdict, (result.marks & gpu::kMarkEarly) != 0)) {
    result.state = {verdict, history.state.lod, history.state.tessellation,
                    lvWaitsForBlock(view) ? history.state.lv : lv};
  } else {
    // A calm level that the budget of the last frame made coarser comes back at once.
    const bool limited = history.remembered && (history.marks & gpu::kMarkLimited) != 0;
    const bool seen = history.known && (!history.counted || history.pixels > 0) && !limited;
    DetailInput input = detailInput(scene, chain, result.box, seen, history.state);
    input.area = size.x * size.y;
    input.price = last.price;
    chooseDetail(view, input, result.state, result.marks);
  }
  return result;
}

}  // namespace jalousie::visibility
