// Steps of frustum culling change the tests, never a verdict.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "culling/frustum_tree.h"
#include "scene/camera.h"

namespace jalousie::culling {
namespace {

std::vector<Aabb> boxesOf(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 center(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-40, 40));
    const float half = std::exp2(-random.uniform(0.0F, 8.0F));
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

scene::Camera cameraOf(Random& random) {
  const glm::vec3 eye(random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50));
  scene::Camera camera = scene::lookAt(eye, {random.uniform(-5, 5), 0, 0}, {glm::vec3(-40), glm::vec3(40)});
  camera.fovY = random.uniform(0.1F, 1.5F);
  if (random.below(2) == 0) camera.zFar = random.uniform(20.0F, 100.0F);
  if (random.below(4) == 0) camera.halfSize = glm::vec2(random.uniform(1.0F, 20.0F));
  if (camera.isOrthographic() && !camera.zFar) camera.zFar = 100.0F;
  return camera;
}

FrustumSteps stepsOf(unsigned bits) {
  return {(bits & 1U) != 0, (bits & 2U) != 0, (bits & 4U) != 0, (bits & 8U) != 0};
}

TEST(FrustumTree, EveryCombinationOfStepsGivesTheVerdictsOfTheFlatTest) {
  Random random(7);
  for (const std::size_t count : {0U, 1U, 3U, 2000U}) {
    const std::vector<Aabb> boxes = boxesOf(count, count);
    const SpatialHierarchy tree = buildHierarchy(boxes);
    std::vector<FrustumCuller> cullers(16, FrustumCuller(tree));
    for (int frame = 0; frame < 12; ++frame) {
      const Frustum frustum(scene::clipFromWorld(cameraOf(random), 1.6F));
      std::vector<std::uint8_t> expected;
      for (const Aabb& box : boxes)
        expected.push_back(frustum.holdsPartOf(box) ? 1 : 0);
      for (unsigned bits = 0; bits < 16; ++bits) {
        std::vector<std::uint8_t> inside;
        cullers[bits].cull(frustum, stepsOf(bits), inside);
        ASSERT_EQ(inside, expected) << count << " objects, steps " << bits;
      }
    }
  }
}

TEST(FrustumTree, EachStepSavesTests) {
  const std::vector<Aabb> boxes = boxesOf(5000, 1);
  const SpatialHierarchy tree = buildHierarchy(boxes);
  scene::Camera camera = scene::lookAt({0, 0, 60}, {0, 0, 0}, {glm::vec3(-40), glm::vec3(40)});
  camera.fovY = 0.2F;
  const Frustum frustum(scene::clipFromWorld(camera, 1.6F));
  const auto planes = [&](const FrustumSteps& steps) {
    FrustumCuller culler(tree);
    std::vector<std::uint8_t> inside;
    culler.cull(frustum, steps, inside);
    return culler.cull(frustum, steps, inside).planesOfBoxes;  // the second frame knows the last planes
  };
  const std::uint64_t flat = planes({false, false, false, false});
  const std::uint64_t flatLast = planes({false, false, true, false});
  const std::uint64_t clark = planes({true, false, false, false});
  const std::uint64_t masked = planes({true, true, false, false});
  const std::uint64_t all = planes({true, true, true, false});
  EXPECT_LT(flatLast, flat);
  EXPECT_LT(clark, flat);
  EXPECT_LT(masked, clark);
  EXPECT_LT(all, masked);
  EXPECT_LT(planes({true, true, true, true}), all) << "spheres decide instead of boxes";
}

TEST(Frustum, PointsOnAPlaneAreInside) {
  scene::Camera camera;
  camera.zNear = 1.0F;
  camera.fovY = 2.0F * std::atan(1.0F);
  const Frustum frustum(scene::clipFromWorld(camera, 1.0F));
  EXPECT_TRUE(frustum.holdsPartOf({{2, 0, -2}, {2, 0, -2}}));
  EXPECT_FALSE(frustum.holdsPartOf({{2.1F, 0, -2}, {3, 0, -2}}));
  EXPECT_FALSE(frustum.holdsPartOf({{0, 0, 1}, {0, 0, 2}})) << "behind the eye";
}

}  // namespace
}  // namespace jalousie::culling
