// Frustum test, screen rectangles and occluder choice, against geometry worked out by hand and by brute force.
#include "visibility/classify_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/random.h"
#include "scene/camera.h"

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
  return boxOnScreen(glm::translate(glm::mat4(1.0F), place), kUnitBox, scene::clipFromWorld(camera, kAspect),
                     kViewport);
}

TEST(Classify, BoxAheadHasACentredRectangle) {
  const BoxOnScreen box = boxAt({0, 0, -10}, cameraAt({0, 0, 0}));
  EXPECT_FALSE(box.outside);
  EXPECT_FALSE(box.crossesNear);
  // The front face at distance 9 has half size 1.
  const float half = scene::focalPixels(cameraAt({0, 0, 0}), 720) / 9.0F;
  EXPECT_NEAR(box.rect.minX, 640.0F - half, 1e-2F);
  EXPECT_NEAR(box.rect.maxX, 640.0F + half, 1e-2F);
  EXPECT_NEAR(box.rect.minY, 360.0F - half, 1e-2F);
  EXPECT_NEAR(box.rect.maxY, 360.0F + half, 1e-2F);
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
    const BoxOnScreen box = boxOnScreen(world, kUnitBox, clip, kViewport);
    for (int k = 0; k < 20; ++k) {
      const glm::vec4 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1.0F);
      const glm::vec4 c = clip * world * p;
      const bool inside = std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z >= 0.0F && c.z <= c.w;
      if (!inside) continue;
      ASSERT_FALSE(box.outside);
      if (box.crossesNear) continue;
      const glm::vec2 pixel = (glm::vec2(c) / c.w * 0.5F + 0.5F) * kViewport;
      ASSERT_GE(pixel.x, box.rect.minX - 1e-2F);
      ASSERT_LE(pixel.x, box.rect.maxX + 1e-2F);
      ASSERT_GE(pixel.y, box.rect.minY - 1e-2F);
      ASSERT_LE(pixel.y, box.rect.maxY + 1e-2F);
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
  view.cullMode = gpu::kCullHom;
  EXPECT_EQ(classify(boxAt({0, 0, -10}, camera), view), gpu::kVerdictOccluder);
  EXPECT_EQ(classify(boxAt({0, 0, -12}, camera), view), gpu::kVerdictPending);
  EXPECT_EQ(classify(boxAt({0, 0, 0}, camera), view), gpu::kVerdictOccluder);
  view.occluderDistance = 0.0F;
  EXPECT_EQ(classify(boxAt({0, 0, 0}, camera), view), gpu::kVerdictNear);
  view.occluderDistance = 10.0F;
  view.cullMode = gpu::kCullFrustum;
  EXPECT_EQ(classify(boxAt({0, 0, -10}, camera), view), gpu::kVerdictPending);
  EXPECT_EQ(classify(boxAt({0, 50, -10}, camera), view), gpu::kVerdictOutside);
  view.cullMode = gpu::kCullNone;
  EXPECT_EQ(classify(boxAt({0, 50, -10}, camera), view), gpu::kVerdictPending);
}

}  // namespace
}  // namespace jalousie::visibility
