// Frustum test, screen rectangles and occluder choice, against geometry worked out by hand and by brute force.
#include "visibility/classify_reference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "core/random.h"
#include "policy/frame_policy.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "visibility/touching_boxes.h"

namespace jalousie::visibility {
namespace {

const Aabb kUnitBox{glm::vec3(-1.0F), glm::vec3(1.0F)};
constexpr float kAspect = 16.0F / 9.0F;
const glm::vec2 kViewport(1280.0F, 720.0F);

scene::Camera cameraAt(const glm::vec3& eye) {
  scene::Camera camera = scene::lookAt(eye, eye + glm::vec3(0, 0, -1), kUnitBox);
  camera.zNear = 0.1F;
  camera.zFar = 100.0F;
  return camera;
}

BoxOnScreen boxAt(const glm::vec3& place, const scene::Camera& camera) {
  return boxOnScreen(scene::makeTransform(glm::translate(glm::mat4(1.0F), place)), kUnitBox,
                     scene::clipFromWorld(camera, kAspect), kViewport);
}

TEST(Classify, BoxAheadHasACentredRectangle) {
  const BoxOnScreen box = boxAt({0, 0, -10}, cameraAt({0, 0, 0}));
  EXPECT_FALSE(box.outside);
  EXPECT_FALSE(box.crossesNear);
  // The front face at distance 9 has half size 1.
  const float half = scene::focalPixels(cameraAt({0, 0, 0}), {1280, 720}) / 9.0F;
  EXPECT_NEAR(box.rect.x, 640.0F - half, 1e-2F);
  EXPECT_NEAR(box.rect.z, 640.0F + half, 1e-2F);
  EXPECT_NEAR(box.rect.y, 360.0F - half, 1e-2F);
  EXPECT_NEAR(box.rect.w, 360.0F + half, 1e-2F);
}

TEST(Classify, OrthographicDistancesAreThoseFromThePlaneOfTheCamera) {
  gpu::CullView view{};
  view.cameraWorld = {0, 0, 10, 0};
  view.forwardWorld = {0, 0, -1, 1};
  EXPECT_FLOAT_EQ(distanceFromEye(view, kUnitBox), 9.0F);
  EXPECT_FLOAT_EQ(distanceFromEye(view, {{50, -80, -1}, {60, 80, 1}}), 9.0F) << "however far at the side";
  EXPECT_FLOAT_EQ(distanceFromEye(view, {{-1, -1, 9}, {1, 1, 11}}), 0.0F);
  EXPECT_FLOAT_EQ(distanceFromEye(view, {{-1, -1, 12}, {1, 1, 13}}), 0.0F);
  view.forwardWorld.w = 0.0F;
  EXPECT_FLOAT_EQ(distanceFromEye(view, {{30, -1, -29}, {31, 1, -30}}),
                  distanceToBox({0, 0, 10}, {{30, -1, -29}, {31, 1, -30}}));
}

TEST(Classify, BoxesBeyondEachPlaneAreOutside) {
  const scene::Camera camera = cameraAt({0, 0, 0});
  EXPECT_TRUE(boxAt({-50, 0, -10}, camera).outside);
  EXPECT_TRUE(boxAt({50, 0, -10}, camera).outside);
  EXPECT_TRUE(boxAt({0, -50, -10}, camera).outside);
  EXPECT_TRUE(boxAt({0, 50, -10}, camera).outside);
  EXPECT_TRUE(boxAt({0, 0, 10}, camera).outside);
  EXPECT_TRUE(boxAt({0, 0, -102}, camera).outside);
  EXPECT_FALSE(boxAt({0, 0, -100.5F}, camera).outside);
}

TEST(Classify, BoxAroundTheEyeCrossesTheNearPlane) {
  const BoxOnScreen box = boxAt({0, 0, 0.5F}, cameraAt({0, 0, 0}));
  EXPECT_FALSE(box.outside);
  EXPECT_TRUE(box.crossesNear);
}

TEST(Classify, NoPointOfADrawnBoxLiesOutsideItsRectangle) {
  Random random(11);
  const scene::Camera camera = cameraAt({0, 0, 0});
  const glm::mat4 clip = scene::clipFromWorld(camera, kAspect);
  for (int i = 0; i < 3000; ++i) {
    glm::mat4 world =
        glm::translate(glm::mat4(1.0F), {random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-40, 5)});
    world =
        glm::rotate(world, random.uniform(0, 6), glm::normalize(glm::vec3(random.uniform(), 0.1F, random.uniform())));
    world = glm::scale(world, {random.uniform(0.1F, 3), random.uniform(0.1F, 3), -random.uniform(0.1F, 3)});
    const BoxOnScreen box = boxOnScreen(scene::makeTransform(world), kUnitBox, clip, kViewport);
    for (int k = 0; k < 20; ++k) {
      const glm::vec4 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1.0F);
      const glm::vec4 c = clip * world * p;
      const bool inside = std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z >= 0.0F && c.z <= c.w;
      if (!inside) continue;
      ASSERT_FALSE(box.outside);
      if (box.crossesNear) continue;
      const glm::vec2 pixel = (glm::vec2(c) / c.w * 0.5F + 0.5F) * kViewport;
      ASSERT_GE(pixel.x, box.rect.x);
      ASSERT_LE(pixel.x, box.rect.z);
      ASSERT_GE(pixel.y, box.rect.y);
      ASSERT_LE(pixel.y, box.rect.w);
      ASSERT_LE(c.z / c.w, box.nearestDepth);
    }
  }
}

TEST(Classify, DistanceIsToTheClosestPoint) {
  EXPECT_EQ(distanceToBox({0, 0, 0}, kUnitBox), 0.0F);
  EXPECT_EQ(distanceToBox({3, 0, 0}, kUnitBox), 2.0F);
  EXPECT_NEAR(distanceToBox({2, 2, 2}, kUnitBox), std::sqrt(3.0F), 1e-6F);
}

TEST(Classify, NearBoxesAreOccludersOnlyWithAMap) {
  const scene::Camera camera = cameraAt({0, 0, 0});
  gpu::CullView view{};
  view.cameraWorld = glm::vec4(camera.positionWorld(), 1.0F);
  view.occluderDistance = 10.0F;
  view.traits = traitsOf(CullMode::kHom);
  EXPECT_EQ(classify(boxAt({0, 0, -10}, camera), view), gpu::kVerdictOccluder);
  EXPECT_EQ(classify(boxAt({0, 0, -12}, camera), view), gpu::kVerdictPending);
  EXPECT_EQ(classify(boxAt({0, 0, 0}, camera), view), gpu::kVerdictOccluder);
  view.occluderDistance = 0.0F;
  EXPECT_EQ(classify(boxAt({0, 0, 0}, camera), view), gpu::kVerdictNear);
  view.occluderDistance = 10.0F;
  view.traits = traitsOf(CullMode::kFrustum);
  EXPECT_EQ(classify(boxAt({0, 0, -10}, camera), view), gpu::kVerdictPending);
  EXPECT_EQ(classify(boxAt({0, 50, -10}, camera), view), gpu::kVerdictOutside);
  view.traits = traitsOf(CullMode::kFull);
  EXPECT_EQ(classify(boxAt({0, 50, -10}, camera), view), gpu::kVerdictPending);
}

TEST(Classify, BoundsHoldFarFromTheOriginWhereRoundingIsLarge) {
  // A small object a million units away from the world's origin, with the camera beside it: sums of large numbers.
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const glm::vec3 origin(random.uniform(-1e6F, 1e6F), random.uniform(-1e4F, 1e4F), random.uniform(-1e6F, 1e6F));
    scene::Camera camera = cameraAt({0, 0, 0});
    camera.worldFromCamera = glm::translate(glm::mat4(1.0F), origin) *
                             glm::rotate(glm::mat4(1.0F), random.uniform(0, 6), glm::vec3(0, 1, 0));
    const glm::mat4 clip = scene::clipFromWorld(camera, kAspect);
    const glm::mat4 world =
        camera.worldFromCamera * glm::translate(glm::mat4(1.0F), {0, 0, -random.uniform(1.0F, 30.0F)});
    const gpu::Transform transform = scene::makeTransform(world);
    const BoxOnScreen box = boxOnScreen(transform, kUnitBox, clip, kViewport);
    if (box.crossesNear) continue;
    for (int k = 0; k < 20; ++k) {
      // The vertex stage's own arithmetic, in another order of the products.
      const glm::vec4 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1.0F);
      const glm::vec4 c =
          clip * glm::vec4(glm::dot(p, transform.worldFromObject0), glm::dot(p, transform.worldFromObject1),
                           glm::dot(p, transform.worldFromObject2), 1.0F);
      if (!(std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z >= 0.0F && c.z <= c.w)) continue;
      ASSERT_FALSE(box.outside);
      const glm::vec2 pixel = (glm::vec2(c) / c.w * 0.5F + 0.5F) * kViewport;
      ASSERT_GE(pixel.x, box.rect.x);
      ASSERT_LE(pixel.x, box.rect.z);
      ASSERT_LE(c.z / c.w, box.nearestDepth);
    }
  }
}

TEST(Classify, WhatTouchesAPlaneIsKept) {
  // Far from the origin, where clip space is a sum of large numbers that cancel.
  Random random(23);
  std::array<int, 6> needed{};  // per plane: boxes that only the margin keeps
  for (int i = 0; i < 100; ++i) {
    const glm::vec3 origin(random.uniform(-1e4F, 1e4F), random.uniform(-1e3F, 1e3F), random.uniform(-1e4F, 1e4F));
    scene::Camera camera = cameraAt({0, 0, 0});
    camera.worldFromCamera = glm::translate(glm::mat4(1.0F), origin) *
                             glm::rotate(glm::mat4(1.0F), random.uniform(0, 6), glm::vec3(0, 1, 0));
    const glm::mat4 clip = scene::clipFromWorld(camera, kAspect);
    const glm::vec3 start(camera.worldFromCamera * glm::vec4(0, 0, -10, 1));
    const std::vector<glm::mat4> worlds = touchingBoxes(clip, start, kUnitBox, 60, random, scene::makeTransform);
    for (std::size_t k = 0; k < worlds.size(); ++k) {
      const gpu::Transform transform = scene::makeTransform(worlds[k]);
      if (!touchesFrustum(cornersInside(clip, transform, kUnitBox))) continue;
      ASSERT_FALSE(boxOnScreen(transform, kUnitBox, clip, kViewport).outside) << "plane " << k % 6;
      if (boxOnScreen(transform, kUnitBox, clip, kViewport, 0.0F).outside) ++needed[k % 6];
    }
  }
  for (std::size_t plane = 0; plane < needed.size(); ++plane)
    EXPECT_GT(needed[plane], 0) << "no box tells whether plane " << plane << " has a margin";
}

TEST(Classify, LargestScaleIsExactForOrthogonalAxesAndNeverTooSmall) {
  EXPECT_FLOAT_EQ(largestScale(scene::makeTransform(glm::scale(glm::mat4(1.0F), {2, -5, 0.5F}))), 5.0F);
  EXPECT_FLOAT_EQ(largestScale(scene::makeTransform(glm::mat4(0.0F))), 0.0F);
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    glm::mat4 m(1.0F);
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r)
        m[c][r] = random.uniform(-2, 2);
    const glm::vec3 v = glm::normalize(glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    ASSERT_GE(largestScale(scene::makeTransform(m)), 0.9999F * glm::length(glm::mat3(m) * v));
  }
}

TEST(Classify, MirroredTransformsAreRecognised) {
  EXPECT_FALSE(isMirrored(scene::makeTransform(glm::mat4(1.0F))));
  EXPECT_TRUE(isMirrored(scene::makeTransform(glm::scale(glm::mat4(1.0F), {1, -1, 1}))));
  EXPECT_FALSE(isMirrored(scene::makeTransform(glm::scale(glm::mat4(1.0F), {-1, -1, 1}))));
}

TEST(Classify, PhasesFollowModeVerdictAndHistory) {
  const gpu::uint seen = gpu::kMarkVisible;
  for (const CullMode mode : {CullMode::kFrustum, CullMode::kHom, CullMode::kHomDepth, CullMode::kHiz})
    for (const bool was : {false, true})
      for (const gpu::uint gone : {gpu::kVerdictOutside, gpu::kVerdictSmall})
        EXPECT_EQ(phasesOf(gone, was, traitsOf(mode)), 0U);
  EXPECT_EQ(phasesOf(gpu::kVerdictPending, false, traitsOf(CullMode::kFrustum)), gpu::kMarkLate | seen);
  EXPECT_EQ(phasesOf(gpu::kVerdictPending, true, traitsOf(CullMode::kHom)), 0U);  // the map decides
  EXPECT_EQ(phasesOf(gpu::kVerdictOccluder, false, traitsOf(CullMode::kHom)), gpu::kMarkEarly | gpu::kMarkLate | seen);
  EXPECT_EQ(phasesOf(gpu::kVerdictNear, false, traitsOf(CullMode::kHomDepth)), gpu::kMarkLate | seen);
  const gpu::uint tested = gpu::kMarkTested;
  EXPECT_EQ(phasesOf(gpu::kVerdictPending, false, traitsOf(CullMode::kHiz)), tested);  // the test decides
  EXPECT_EQ(phasesOf(gpu::kVerdictPending, true, traitsOf(CullMode::kHiz)), gpu::kMarkEarly | seen | tested);
  EXPECT_EQ(phasesOf(gpu::kVerdictNear, false, traitsOf(CullMode::kHiz)), gpu::kMarkEarly | seen | tested);
}

TEST(Classify, WhatIsNewInViewIsExpectedVisibleIfItIsLarge) {
  gpu::CullView view{};
  view.viewportWidth = 320;
  view.viewportHeight = 100;  // a thirty-second of it are 1000 pixels
  const glm::vec4 large(0, 0, 50, 20);
  const glm::vec4 small(0, 0, 49, 20);
  EXPECT_TRUE(isExpectedVisible(0, large, view));
  EXPECT_FALSE(isExpectedVisible(0, small, view));
  EXPECT_FALSE(isExpectedVisible(gpu::kMarkTested, large, view)) << "hidden a frame ago";
  EXPECT_TRUE(isExpectedVisible(gpu::kMarkTested | gpu::kMarkVisible, small, view)) << "seen a frame ago";
}

TEST(Classify, ContributionThresholdCountsTheRectanglesPixelsTimesImportance) {
  const scene::Camera camera = cameraAt({0, 0, 0});
  gpu::CullView view{};
  view.traits = traitsOf(CullMode::kFrustum);
  const BoxOnScreen box = boxAt({0, 0, -40}, camera);
  const float area = (box.rect.z - box.rect.x) * (box.rect.w - box.rect.y);
  view.minPixels = 0.99F * area;
  EXPECT_EQ(classify(box, view), gpu::kVerdictPending);
  EXPECT_EQ(classify(box, view, 0.5F), gpu::kVerdictSmall);
  view.minPixels = 1.01F * area;
  EXPECT_EQ(classify(box, view), gpu::kVerdictSmall);
  EXPECT_EQ(classify(boxAt({0, 0, 0}, camera), view), gpu::kVerdictNear);
}

/// Area of a sphere on the screen by counting the rays that hit it.
double countedArea(const glm::dvec3& center, double radius, double focal) {
  double area = 0.0;
  const double step = 0.005 * focal;
  for (int y = -600; y <= 600; ++y) {
    for (int x = -600; x <= 600; ++x) {
      const glm::dvec3 ray = glm::normalize(glm::dvec3(x * step, y * step, -focal));
      const double along = glm::dot(center, ray);
      const double missed = glm::dot(center, center) - along * along;
      if (along > 0.0 && missed <= radius * radius) area += step * step;
    }
  }
  return area;
}

/// A box whose bounding sphere has a radius of 1.
Aabb boxInUnitSphere(const glm::vec3& center) {
  const glm::vec3 half(1.0F / std::sqrt(3.0F));
  return {center - half, center + half};
}

TEST(Classify, SphereAreaIsThatOfTheEllipse) {
  gpu::CullView view{};
  view.forwardWorld = {0, 0, -1, 0};
  view.focalPixels = 100.0F;
  for (const glm::vec3 center : {glm::vec3(0, 0, -5), glm::vec3(3, -2, -4), glm::vec3(-1, 1, -1.8F)})
    EXPECT_NEAR(sphereArea(view, boxInUnitSphere(center)) / countedArea(center, 1.0, 100.0), 1.0, 0.01);
  // The estimate pi (r f / d)^2 is .96 of it at five radii, .56 at one and a half.
  const auto share = [&](float d) {
    return 3.14159265F * 1e4F / (d * d) / sphereArea(view, boxInUnitSphere({0, 0, -d}));
  };
  EXPECT_NEAR(share(5.0F), 0.96F, 0.005F);
  EXPECT_NEAR(share(1.5F), 0.56F, 0.005F);
  EXPECT_TRUE(std::isinf(sphereArea(view, boxInUnitSphere({0, 0, -0.9F}))));
  EXPECT_TRUE(std::isinf(sphereArea(view, boxInUnitSphere({0, 0, 3}))));
  view.forwardWorld.w = 1.0F;
  EXPECT_NEAR(sphereArea(view, boxInUnitSphere({0, 0, -9})), 3.14159265F * 1e4F, 1.0F);
}

TEST(Classify, DetailCullingComparesTheSpheresArea) {
  const scene::Camera camera = cameraAt({0, 0, 0});
  gpu::CullView view{};
  view.traits = traitsOf(CullMode::kFrustum);
  view.forwardWorld = {0, 0, -1, 0};
  view.focalPixels = 100.0F;
  const BoxOnScreen box = boxAt({0, 0, -40}, camera);
  const float area = sphereArea(view, box.boundsWorld);
  view.minSpherePixels = 0.99F * area;
  EXPECT_EQ(classify(box, view), gpu::kVerdictPending);
  EXPECT_EQ(classify(box, view, 0.5F), gpu::kVerdictSmall);
  view.minSpherePixels = 1.01F * area;
  EXPECT_EQ(classify(box, view), gpu::kVerdictSmall);
}

}  // namespace
}  // namespace jalousie::visibility
