// classify.comp against its CPU twin, on random and adversarial input with history.
//
// Kernel and twin evaluate the same formulas in 32-bit floats, but a GPU may fuse a product with a sum, and divide with
// an error of 2.5 ulp. Two evaluations of one clip-space component then differ by at most kRounding times the sum of
// the magnitudes that go into it: each is a sum of four products of sums of four products, at most 8 roundings of 2^-24
// of that sum, so 2^-21, for each of the two. All that follows a component, the guard included, is monotone in this
// bound: the kernel's rectangle contains the twin's without any guard and lies within the twin's with twice the guard.
// What the kernel may write is therefore what the twin finds between these two (Bracket), and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <set>
#include <vector>

#include "core/random.h"
#include "policy/traits.h"
#include "render/scene_buffers.h"
#include "shared/limits.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/classify_reference.h"
#include "visibility/kernel_input.h"
#include "visibility/lod_policy.h"
#include "visibility/touching_boxes.h"
#include "visibility/visibility_pass.h"

namespace jalousie::visibility {
namespace {

using scene::SceneData;

/// A few roundings of the arithmetic behind clip space: at most 8 of 2^-24 each.
constexpr float kFewUlps = 1.0F / 2097152.0F;  // 2^-21

/// The twin's box without a guard, with the kernel's and with twice that.
struct Bracket {
  Bracket(const SceneData& scene, std::size_t object, const gpu::CullView& view) {
    const gpu::Chain& chain = scene.chains[scene.objects[object].chain];
    const Aabb bounds{glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)};
    const glm::vec2 viewport(view.viewportWidth, view.viewportHeight);
    for (std::size_t i = 0; i < 3; ++i)
      boxes[i] = boxOnScreen(scene.transforms[scene.objects[object].transform], bounds, view.clipFromWorld, viewport,
                             static_cast<float>(i) * gpu::kRounding);
    const glm::vec4 reach(glm::max(glm::abs(bounds.min), glm::abs(bounds.max)), 1.0F);
    const gpu::Transform& t = scene.transforms[scene.objects[object].transform];
    const glm::vec3 world(glm::dot(glm::abs(t.worldFromObject0), reach), glm::dot(glm::abs(t.worldFromObject1), reach),
                          glm::dot(glm::abs(t.worldFromObject2), reach));
    worldError = kFewUlps * (glm::length(world) + glm::length(glm::vec3(view.cameraWorld)));
  }

  /// Area of a bracketing rectangle, pixels.
  float area(std::size_t i) const { return (boxes[i].rect.z - boxes[i].rect.x) * (boxes[i].rect.w - boxes[i].rect.y); }

  BoxOnScreen boxes[3];
  float worldError = 0.0F;  ///< of a distance between points of the box and the camera, world units
};

/// Every verdict that the kernel may give: those of the bracketing boxes, with thresholds that the rounding of the
/// quantity compared with them may shift. Where no quantity lies that close to its threshold, this is one verdict.
std::set<gpu::uint> plausibleVerdicts(const Bracket& bracket, const gpu::CullView& view,
                                      const ImportanceMask* importance) {
  std::set<gpu::uint> verdicts;
  for (const BoxOnScreen& box : bracket.boxes) {
    const bool hasRect = !box.outside && !box.crossesNear;
    const float weight = hasRect && importance != nullptr
                             ? importance->largestIn(box.rect, view.viewportWidth, view.viewportHeight)
                             : 1.0F;
    for (const float sign : {-1.0F, 0.0F, 1.0F}) {
      for (const float distanceSign : {-1.0F, 0.0F, 1.0F}) {
        gpu::CullView changed = view;
        changed.minPixels *= 1.0F + sign * kFewUlps;
        changed.minSpherePixels *= 1.0F + sign * 64.0F * kFewUlps;  // differences of squares lose bits
        changed.occluderDistance += distanceSign * bracket.worldError;
        verdicts.insert(classify(box, changed, weight));
      }
    }
  }
  return verdicts;
}

/// Relative error of ScreenBox.pixelsPerUnit, whose denominator is the distance to the box.
float scaleError(const Bracket& bracket, const gpu::CullView& view) {
  if (view.forwardWorld.w != 0.0F) return kFewUlps;  // distances do not count
  const float distance = distanceToBox(glm::vec3(view.cameraWorld), bracket.boxes[1].boundsWorld);
  const float denominator = std::max(distance, view.cameraWorld.w);
  return kFewUlps + 2.0F * bracket.worldError / denominator;
}

void expectPlausibleBox(const gpu::ScreenBox& actual, const gpu::ScreenBox& expected, const Bracket& bracket,
                        const gpu::CullView& view) {
  const glm::vec4& inner = bracket.boxes[0].rect;
  const glm::vec4& outer = bracket.boxes[2].rect;
  const float x = kFewUlps * static_cast<float>(view.viewportWidth);
  const float y = kFewUlps * static_cast<float>(view.viewportHeight);
  EXPECT_TRUE(actual.minX >= outer.x - x && actual.minX <= inner.x + x) << actual.minX << " for " << expected.minX;
  EXPECT_TRUE(actual.minY >= outer.y - y && actual.minY <= inner.y + y) << actual.minY << " for " << expected.minY;
  EXPECT_TRUE(actual.maxX <= outer.z + x && actual.maxX >= inner.z - x) << actual.maxX << " for " << expected.maxX;
  EXPECT_TRUE(actual.maxY <= outer.w + y && actual.maxY >= inner.w - y) << actual.maxY << " for " << expected.maxY;
  EXPECT_GE(actual.nearestDepth, bracket.boxes[0].nearestDepth * (1.0F - kFewUlps));
  EXPECT_LE(actual.nearestDepth, bracket.boxes[2].nearestDepth * (1.0F + kFewUlps));
  EXPECT_NEAR(actual.pixelsPerUnit, expected.pixelsPerUnit, scaleError(bracket, view) * expected.pixelsPerUnit);
  EXPECT_NEAR(actual.tau, expected.tau, kFewUlps * expected.tau);
}

/// Shares from open to covered, and chords of less than a pixel up to no masking.
gpu::uint coverOf(Random& random) {
  return glm::packHalf2x16({0.25F * static_cast<float>(random.below(5)), random.uniform(0.5F, 80.0F)});
}

/// Random history: what was visible and drawn in the last frame, calm or not, counted or not, in a cross-fade or not.
std::vector<LastFrame> randomHistory(const SceneData& scene, const gpu::CullView& view) {
  std::vector<LastFrame> last(scene.objects.size());
  Random random(31);
  for (std::size_t i = 0; i < last.size(); ++i) {
    const gpu::Chain& chain = scene.chains[scene.objects[i].chain];
    last[i].state = {random.below(3) == 0 ? gpu::kVerdictOpen : gpu::kVerdictPartial, random.below(chain.lodCount),
                     1 + random.below(view.maxTessellation), random.uniform(-1.5F, 1.0F)};
    constexpr gpu::uint kHistories[] = {0, gpu::kMarkTested, gpu::kMarkTested | gpu::kMarkVisible, gpu::kMarkVisible};
    last[i].marks = kHistories[random.below(4)];
    if (random.below(2) == 0) last[i].marks |= random.below(2) == 0 ? gpu::kMarkEarly : gpu::kMarkLate;
    if (random.below(2) == 0) last[i].marks |= gpu::kMarkCounted;
    if (random.below(2) == 0) last[i].marks |= gpu::kMarkCalm;
    if (random.below(2) == 0) last[i].marks |= gpu::kMarkMeasured;
    const gpu::uint frames = random.below(3) == 0 ? random.below(gpu::kDefaultFadeFrames + 1) : 0;
    const bool fromCoarser = last[i].state.lod == 0 || random.below(2) == 0;
    if (frames > 0) last[i].marks |= frames << gpu::kMarkFadeShift | (fromCoarser ? gpu::kMarkFromCoarser : 0);
    last[i].cover = random.below(4) == 0 ? random.below(0xffffffffU) : coverOf(random);
    last[i].pixels = random.below(3) == 0 ? 0 : random.below(1U << random.below(16));
  }
  return last;
}

/// What the kernel wrote, in the order of the objects.
std::vector<ObjectDecision> runKernel(const SceneData& scene, const gpu::CullView& view,
                                      const std::vector<LastFrame>& last, const ImportanceMask* importance) {
  const render::SceneBuffers buffers(scene);
  ObjectStore objects(buffers.objectCount());
  VisibilityPass pass(objects, importance);
  std::vector<gpu::ObjectState> lastStates;
  std::vector<gpu::uint> lastMarks;
  std::vector<gpu::uint> lastPixels;
  std::vector<gpu::ScreenBox> lastBoxes;
  for (const LastFrame& frame : last) {
    lastStates.push_back(frame.state);
    lastMarks.push_back(frame.marks);
    lastPixels.push_back(frame.pixels);
    lastBoxes.emplace_back().cover = frame.cover;
  }
  objects.states.write(0, std::as_bytes(std::span(lastStates)));
  objects.marks.write(0, std::as_bytes(std::span(lastMarks)));
  objects.boxes.write(0, std::as_bytes(std::span(lastBoxes)));
  objects.pixelCounts.write(0, std::as_bytes(std::span(lastPixels)));
  objects.countsValid = view.countsValid != 0;
  pass.setView(view);
  pass.classify(buffers.bindings());
  const auto states = objects.states.read<gpu::ObjectState>(scene.objects.size());
  const auto boxes = objects.boxes.read<gpu::ScreenBox>(scene.objects.size());
  const auto marks = objects.marks.read<gpu::uint>(scene.objects.size());
  std::vector<ObjectDecision> decisions;
  for (std::size_t i = 0; i < states.size(); ++i)
    decisions.push_back({states[i], boxes[i], marks[i]});
  return decisions;
}

/// One object, its history and the view.
struct Case {
  const SceneData& scene;
  const gpu::CullView& view;
  gpu::uint object;
  const LastFrame& last;
  const ImportanceMask* importance;
};

/// Whether the kernel's level is one that the twin chooses for a budget within its error. Levels follow from
/// tau / pixelsPerUnit and from the visible share, in which the rectangle's area counts once.
bool hasPlausibleLevel(const Case& c, const ObjectDecision& actual, float error) {
  for (const glm::vec2 signs :
       {glm::vec2(-1, -1), {0, -1}, {1, -1}, {-1, 0}, {0, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
    gpu::CullView changed = c.view;
    changed.tau *= 1.0F + signs.x * error;
    changed.maxError *= 1.0F + signs.y * error;
    const ObjectDecision expected = classifyObject(c.scene, changed, c.object, c.last, c.importance);
    if (actual.state.lod == expected.state.lod && actual.state.tessellation == expected.state.tessellation)
      return actual.marks == expected.marks;
  }
  return false;
}

void compareObject(const Case& c, const ObjectDecision& actual) {
  const Bracket bracket(c.scene, c.object, c.view);
  const std::set<gpu::uint> plausible = plausibleVerdicts(bracket, c.view, c.importance);
  const ObjectDecision expected = classifyObject(c.scene, c.view, c.object, c.last, c.importance);
  EXPECT_TRUE(plausible.contains(actual.state.verdict))
      << "verdict " << actual.state.verdict << " expected " << expected.state.verdict;
  if (actual.state.verdict != expected.state.verdict) return;  // as far off as rounding allows
  // LV of counted pixels changes at most by twice the relative change of the area; all other LV are copied or smoothed.
  const bool hasRect = !bracket.boxes[1].outside && !bracket.boxes[1].crossesNear;
  const float areaError = hasRect && has(c.view.traits, gpu::kTraitLvPixels)
                              ? (bracket.area(2) - bracket.area(0)) / std::max(bracket.area(0), 1.0F)
                              : 0.0F;
  EXPECT_NEAR(actual.state.lv, expected.state.lv, 2.0F * areaError + kFewUlps);
  // Pixels that follow from LV are off by a rounding of LV times the area; at least one pixel counts.
  const float area = hasRect ? bracket.area(1) : static_cast<float>(c.view.viewportWidth * c.view.viewportHeight);
  const float pixelError = has(c.view.traits, gpu::kTraitPrice) ? kFewUlps * area : 0.0F;
  EXPECT_TRUE(hasPlausibleLevel(c, actual, areaError + pixelError + scaleError(bracket, c.view)))
      << "lod " << actual.state.lod << " for " << expected.state.lod << ", tessellation " << actual.state.tessellation
      << " for " << expected.state.tessellation << ", marks " << actual.marks << " for " << expected.marks;
  EXPECT_EQ(actual.box.cover, expected.box.cover);
  if (hasRect) expectPlausibleBox(actual.box, expected.box, bracket, c.view);
}

/// Runs the kernel on a random history and compares everything it writes with the twin.
void compareClassification(const SceneData& scene, gpu::CullView view, const ImportanceMask* importance = nullptr,
                           bool countsValid = true) {
  view.countsValid = countsValid ? 1 : 0;
  const std::vector<LastFrame> last = randomHistory(scene, view);
  const std::vector<ObjectDecision> actual = runKernel(scene, view, last, importance);
  for (gpu::uint i = 0; i < scene.objects.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "object " << i);
    compareObject({scene, view, i, last[i], importance}, actual[i]);
  }
}

class ClassifyGl : public test::GlTest {};

TEST_F(ClassifyGl, RandomScenesFromOutsideAndInside) {
  const SceneData scene = scene::buildScene(test::randomSpheres(500, 10.0F, 1));
  for (const glm::vec3 eye : {glm::vec3(0, 0, 40), glm::vec3(3, 2, 1), glm::vec3(-12, 9, 0)})
    for (const ScreenSize size : kSizes)
      compareClassification(scene, makeView(scene, scene::lookAt(eye, {0, 0.5F, 0}, scene.boundsWorld), size, 15.0F));
}

TEST_F(ClassifyGl, OrthographicCamerasFromOutsideAndInside) {
  const SceneData scene = scene::buildScene(test::randomSpheres(500, 10.0F, 1));
  for (const glm::vec3 eye : {glm::vec3(0, 0, 40), glm::vec3(3, 2, 1), glm::vec3(-12, 9, 0)})
    for (const ScreenSize size : kSizes) {
      scene::Camera camera = scene::lookAt(eye, {0, 0.5F, 0}, scene.boundsWorld);
      camera.halfSize = glm::vec2(5.0F, 3.0F);
      camera.zNear = 0.0F;
      camera.zFar = 45.0F;
      for (const FramePolicy& policy : {FramePolicy{}, FramePolicy{.cullMode = CullMode::kHom}})
        compareClassification(scene, makeView(scene, camera, size, 32.0F, policy));
    }
}

TEST_F(ClassifyGl, AnOrthographicLevelDoesNotDependOnTheDistance) {
  asset::SceneFile file = test::sphereChain(4);
  for (int i = 0; i < 12; ++i)
    test::addInstance(file, 0, {-11.0F + 2.0F * static_cast<float>(i), 0, -8.0F * static_cast<float>(i)}, glm::vec3(1));
  const SceneData scene = scene::buildScene(file);
  std::set<gpu::uint> levels;
  for (const float halfHeight : {2.0F, 30.0F, 500.0F}) {
    scene::Camera camera = scene::lookAt({0, 0, 10}, {0, 0, 0}, scene.boundsWorld);
    camera.halfSize = glm::vec2(16.0F, halfHeight);
    camera.zNear = 0.0F;
    camera.zFar = 200.0F;
    const FramePolicy policy{.cullMode = CullMode::kFrustum, .lodRule = LodRule::kPixelError};
    const gpu::CullView view = makeView(scene, camera, {640, 360}, 0.0F, policy);
    const std::vector<ObjectDecision> decisions =
        runKernel(scene, view, std::vector<LastFrame>(scene.objects.size()), nullptr);
    for (const ObjectDecision& decision : decisions) {
      EXPECT_EQ(decision.state.lod, decisions[0].state.lod);
      EXPECT_FLOAT_EQ(decision.box.pixelsPerUnit, 360.0F / (2.0F * std::max(halfHeight, 9.0F)));
    }
    levels.insert(decisions[0].state.lod);
  }
  EXPECT_GE(levels.size(), 2U) << "but on the size of the view";
}

TEST_F(ClassifyGl, AdversarialBoxes) {
  asset::SceneFile file = test::sphereChain(2);
  const glm::vec3 eye(0, 0, 5);
  test::addInstance(file, 0, {0, 0, 5}, glm::vec3(1));          // the eye is inside
  test::addInstance(file, 0, {0, 0, 4.9F}, glm::vec3(0.2F));    // across the near plane
  test::addInstance(file, 0, {0, 0, 6}, glm::vec3(0.5F));       // behind
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1e-6F));      // smaller than a pixel
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(0.0F));       // a point
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1e6F));       // larger than the screen
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1, 0, 1));    // flat
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(-2, 1, -1));  // mirrored twice
  test::addInstance(file, 0, {1e5F, 0, -1e5F}, glm::vec3(1));   // far away
  const SceneData scene = scene::buildScene(file);
  for (const ScreenSize size : kSizes)
    compareClassification(scene,
                          makeView(scene, scene::lookAt(eye, {0, 0, 0}, {glm::vec3(-1), glm::vec3(1)}), size, 3.0F));
}

TEST_F(ClassifyGl, WhatTouchesAPlaneIsKept) {
  Random random(29);
  std::array<int, 6> needed{};  // per plane: boxes that only the twin's margin keeps
  for (int i = 0; i < 20; ++i) {
    asset::SceneFile file = test::sphereChain(1);
    const SceneData shape = scene::buildScene(file);
    const Aabb box{glm::vec3(shape.chains[0].boundsMinObject), glm::vec3(shape.chains[0].boundsMaxObject)};
    const glm::vec3 eye(random.uniform(-1e4F, 1e4F), random.uniform(-1e3F, 1e3F), random.uniform(-1e4F, 1e4F));
    const glm::vec3 start = eye + glm::vec3(random.uniform(-9, 9), 1, 10);
    scene::Camera camera = scene::lookAt(eye, start, {start - glm::vec3(1), start + glm::vec3(1)});
    camera.zNear = 0.1F;
    camera.zFar = 100.0F;
    const gpu::CullView view = makeView(shape, camera, {640, 360}, 3.0F);
    const std::vector<glm::mat4> worlds =
        touchingBoxes(view.clipFromWorld, start, box, 300, random, scene::makeTransform);
    for (const glm::mat4& world : worlds)
      file.instances.push_back({0, world});
    const SceneData scene = scene::buildScene(file);
    gpu::CullView whole = view;
    whole.objectCount = static_cast<gpu::uint>(scene.objects.size());
    const std::vector<ObjectDecision> actual =
        runKernel(scene, whole, std::vector<LastFrame>(scene.objects.size()), nullptr);
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      const gpu::Transform& transform = scene.transforms[scene.objects[k].transform];
      const std::array<double, 6> inside = cornersInside(view.clipFromWorld, transform, box);
      if (!touchesFrustum(inside)) continue;
      ASSERT_NE(actual[k].state.verdict, gpu::kVerdictOutside) << "object " << k;
      const auto plane = static_cast<std::size_t>(std::min_element(inside.begin(), inside.end()) - inside.begin());
      if (boxOnScreen(transform, box, view.clipFromWorld, {640, 360}, 0.0F).outside) ++needed[plane];
    }
  }
  for (std::size_t plane = 0; plane < needed.size(); ++plane)
    EXPECT_GT(needed[plane], 0) << "no box tells whether plane " << plane << " has a margin";
}

TEST_F(ClassifyGl, EveryModeAndRuleWithMaskAndThreshold) {
  ImageRgba8 image{37, 21, std::vector<std::uint8_t>(37 * 21 * 4)};
  Random random(77);
  for (std::uint8_t& byte : image.pixels)
    byte = static_cast<std::uint8_t>(random.below(6) == 0 ? 255 : random.below(60));
  const ImportanceMask mask(image);
  const SceneData scene = scene::buildScene(test::randomSpheres(400, 10.0F, 4), {.patches = true});
  const scene::Camera camera = scene::lookAt({4, 3, 22}, {0, 0.5F, 0}, scene.boundsWorld);
  for (const CullModeRow& mode : cullModeTable()) {
    for (const LodRuleRow& rule : lodRuleTable()) {
      gpu::CullView view = makeView(scene, camera, {640, 360}, 20.0F,
                                    {.cullMode = mode.id, .lodRule = rule.id, .lvMeasure = LvMeasure::kNone});
      view.relax = 8.0F;
      compareClassification(scene, view);
      view.minPixels = 60.0F;
      view.minSpherePixels = 150.0F;
      view.tau = 3.0F;
      compareClassification(scene, view, &mask);
    }
  }
}

TEST_F(ClassifyGl, EveryMeasureCalmAndNot) {
  const SceneData scene = scene::buildScene(test::randomSpheres(400, 10.0F, 9), {.patches = true});
  const scene::Camera camera = scene::lookAt({4, 3, 22}, {0, 0.5F, 0}, scene.boundsWorld);
  for (const CullMode mode : {CullMode::kFrustum, CullMode::kHom, CullMode::kHiz}) {
    for (const LvMeasure measure : {LvMeasure::kChord, LvMeasure::kPixels}) {
      for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
        for (const gpu::uint calm : {0U, 1U, 2U, 3U}) {
          const LodRule rule = calm < 2 ? LodRule::kLvError : LodRule::kPrice;
          gpu::CullView view = makeView(scene, camera, {640, 360}, 20.0F,
                                        {.cullMode = mode, .lodRule = rule, .lvMeasure = measure, .detail = detail});
          view.relax = 64.0F;
          view.tau = 0.3F;
          view.calm = calm % 2;
          compareClassification(scene, view);
          compareClassification(scene, view, nullptr, false);
          view.hysteresis = 1.3F;
          for (const gpu::uint frames : {0U, 3U, gpu::kMaxFadeFrames}) {
            view.fadeFrames = frames;
            compareClassification(scene, view);
          }
        }
      }
    }
  }
}

TEST_F(ClassifyGl, MaskedErrorsInEveryModeCalmAndNot) {
  const SceneData scene = scene::buildScene(test::randomSpheres(400, 10.0F, 12), {.patches = true});
  const scene::Camera camera = scene::lookAt({4, 3, 22}, {0, 0.5F, 0}, scene.boundsWorld);
  for (const CullModeRow& mode : cullModeTable()) {
    for (const LodRule rule : {LodRule::kPixelError, LodRule::kCoverage, LodRule::kLvError, LodRule::kPrice}) {
      for (const LvMeasure measure : {LvMeasure::kCoverage, LvMeasure::kChord, LvMeasure::kPixels}) {
        gpu::CullView view = makeView(scene, camera, {640, 360}, 20.0F,
                                      {.cullMode = mode.id, .lodRule = rule, .lvMeasure = measure, .masking = true});
        view.relax = 64.0F;
        view.tau = 0.3F;
        compareClassification(scene, view);
        view.calm = 1;
        view.hysteresis = 1.3F;
        view.fadeFrames = 3;
        compareClassification(scene, view);
      }
    }
  }
}

TEST_F(ClassifyGl, PricesAtTheirLimits) {
  asset::SceneFile file = test::randomSpheres(300, 10.0F, 12);
  file.chains[0].levels[2].errorObject = std::numeric_limits<float>::infinity();  // unknown
  for (std::size_t k = 1; k < 4; ++k)
    file.chains[0].levels[k].meanErrorObject = 0.1F * file.chains[0].levels[k].errorObject;
  file.chains.push_back({"one level", {file.chains[0].levels[0]}});
  for (std::size_t i = 0; i < file.instances.size(); i += 5)
    file.instances[i].chain = 1;
  const SceneData scene = scene::buildScene(file, {.patches = true});
  const scene::Camera camera = scene::lookAt({4, 3, 22}, {0, 0.5F, 0}, scene.boundsWorld);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float tau : {0.0F, 1e-20F, 1.0F, 1000.0F, 1e19F, kInfinity, std::nanf("")}) {
    for (const float maxError : {0.5F, 8.0F, kInfinity}) {
      for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
        gpu::CullView view = makeView(scene, camera, {640, 360}, 20.0F, {.lodRule = LodRule::kPrice, .detail = detail});
        view.tau = tau;
        view.maxError = maxError;
        SCOPED_TRACE(testing::Message() << "tau " << tau << ", largest deviation " << maxError);
        std::vector<LastFrame> last = randomHistory(scene, view);
        for (std::size_t i = 0; i < last.size(); i += 7)
          last[i].pixels = 0xffffffffU;
        const std::vector<ObjectDecision> actual = runKernel(scene, view, last, nullptr);
        for (gpu::uint i = 0; i < scene.objects.size(); ++i) {
          EXPECT_LT(actual[i].state.lod, scene.chains[scene.objects[i].chain].lodCount);
          EXPECT_NE(actual[i].state.lod, 2U) << "of unknown error";
          EXPECT_GE(actual[i].state.tessellation, 1U);
          EXPECT_LE(actual[i].state.tessellation, view.maxTessellation);
          const ObjectDecision expected = classifyObject(scene, view, i, last[i]);
          EXPECT_EQ(actual[i].state.verdict, expected.state.verdict);
          if (!std::isfinite(tau)) continue;
          compareObject({scene, view, i, last[i], nullptr}, actual[i]);
        }
      }
    }
  }
}

TEST_F(ClassifyGl, CoverageAtItsLimits) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  asset::SceneFile file = test::randomSpheres(300, 10.0F, 12);
  const std::vector<asset::LodLevel> levels = file.chains[0].levels;
  file.chains.push_back({"no thresholds", levels});
  file.chains.push_back({"one threshold", levels, {0.004F}});
  file.chains.push_back({"huge thresholds", levels, {3e38F, 3e38F, 1.0F, 1.0F}});
  file.chains.push_back({"tiny thresholds", levels, {1e-38F, 1e-45F, 0.0F, 0.0F}});
  file.chains.push_back({"one level", {levels[0]}, {0.5F}});
  for (std::size_t i = 0; i < file.instances.size(); ++i)
    file.instances[i].chain = static_cast<std::uint32_t>(i % file.chains.size());
  const SceneData scene = scene::buildScene(file);
  EXPECT_TRUE(scene.hasUncoveredChains);
  const scene::Camera camera = scene::lookAt({4, 3, 22}, {0, 0.5F, 0}, scene.boundsWorld);
  std::size_t drawn[4] = {};
  for (const float tau : {0.0F, 1e-20F, 0.3F, 1.0F, 4.0F, 1000.0F, 1e19F, kInfinity, std::nanf("")}) {
    for (const gpu::uint calm : {0U, 1U}) {
      gpu::CullView view = makeView(scene, camera, {640, 360}, 20.0F, {.lodRule = LodRule::kCoverage});
      view.tau = tau;
      view.calm = calm;
      view.hysteresis = 1.3F;
      SCOPED_TRACE(testing::Message() << "tau " << tau << ", calm " << calm);
      const std::vector<LastFrame> last = randomHistory(scene, view);
      const std::vector<ObjectDecision> actual = runKernel(scene, view, last, nullptr);
      for (gpu::uint i = 0; i < scene.objects.size(); ++i) {
        ASSERT_LT(actual[i].state.lod, scene.chains[scene.objects[i].chain].lodCount);
        if (tau == 1.0F) ++drawn[actual[i].state.lod];
        if (calm == 0 && scene.objects[i].chain == 1) {
          EXPECT_EQ(actual[i].state.lod, 0U);
        }
        if (calm == 0 && scene.objects[i].chain == 2) {
          EXPECT_LE(actual[i].state.lod, 1U);
        }
        if (std::isfinite(tau)) compareObject({scene, view, i, last[i], nullptr}, actual[i]);
      }
    }
  }
  for (const std::size_t objects : drawn)
    EXPECT_GT(objects, 20U);
}

TEST_F(ClassifyGl, RealScenes) {
  const char* folder = std::getenv("JALOUSIE_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "JALOUSIE_SCENES names no folder with the two game scenes";
  for (const char* name : {"candela_city", "cornfield_crossing"}) {
    const SceneData scene =
        scene::buildScene(asset::readSceneFile(std::filesystem::path(folder) / name / "scene.gltf"));
    for (const glm::vec3 eye : {glm::vec3(0, 8, 0), glm::vec3(0, 40, 60), glm::vec3(300, 200, 300)}) {
      compareClassification(scene, makeView(scene, scene::lookAt(eye, {-40, 4, -20}, scene.boundsWorld), {1366, 768},
                                            40.0F, {.lodRule = LodRule::kPixelError, .lvMeasure = LvMeasure::kNone}));
    }
  }
}

TEST_F(ClassifyGl, EmptySceneAndSingleObject) {
  asset::SceneFile file = test::sphereChain(1);
  const SceneData empty = scene::buildScene(file);
  compareClassification(empty, makeView(empty, scene::lookAt({0, 0, 5}, {0, 0, 0}, {}), {64, 64}, 1.0F));
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  const SceneData one = scene::buildScene(file);
  compareClassification(one, makeView(one, scene::lookAt({0, 0, 5}, {0, 0, 0}, one.boundsWorld), {64, 64}, 1.0F));
}

}  // namespace
}  // namespace jalousie::visibility
