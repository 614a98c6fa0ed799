// Camera matrices and recorded paths.
#include "scene/camera.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"

namespace jalousie::scene {
namespace {

const Aabb kBox{glm::vec3(-1.0F), glm::vec3(1.0F)};

float depthOf(const Camera& camera, const glm::vec3& world) {
  const glm::vec4 clip = clipFromWorld(camera, 1.5F) * glm::vec4(world, 1.0F);
  return clip.z / clip.w;
}

TEST(Camera, DepthIsReversed) {
  Camera camera = lookAt({0, 0, 0}, {0, 0, -1}, kBox);
  camera.zNear = 0.5F;
  camera.zFar = 50.0F;
  EXPECT_NEAR(depthOf(camera, {0, 0, -0.5F}), 1.0F, 1e-5F);
  EXPECT_NEAR(depthOf(camera, {0, 0, -50.0F}), 0.0F, 1e-5F);
  EXPECT_GT(depthOf(camera, {0, 0, -2}), depthOf(camera, {0, 0, -3}));
  camera.zFar.reset();
  EXPECT_NEAR(depthOf(camera, {0, 0, -0.5F}), 1.0F, 1e-5F);
  EXPECT_NEAR(depthOf(camera, {0, 0, -1e7F}), 0.0F, 1e-5F);
}

TEST(Camera, OrthographicDepthAndSizeAreLinear) {
  Camera camera = lookAt({1, 2, 3}, {1, 2, -3}, kBox);
  camera.halfSize = glm::vec2(6, 4);
  camera.zNear = 0.0F;
  camera.zFar = 8.0F;
  const auto ndc = [&](float aspect, const glm::vec3& world) {
    const glm::vec4 clip = clipFromWorld(camera, aspect) * glm::vec4(world, 1.0F);
    EXPECT_EQ(clip.w, 1.0F);
    return glm::vec3(clip);
  };
  EXPECT_LT(glm::distance(ndc(1.5F, {7, 6, 3}), {1, 1, 1}), 1e-6F);
  EXPECT_LT(glm::distance(ndc(1.5F, {-5, -2, -5}), {-1, -1, 0}), 1e-6F);
  EXPECT_LT(glm::distance(ndc(1.5F, {1, 4, 1}), {0, 0.5F, 0.75F}), 1e-6F);
  EXPECT_LT(glm::distance(ndc(1.0F, {7, 8, 3}), {1, 1, 1}), 1e-6F) << "a narrow picture shows more above and below";
  EXPECT_LT(glm::distance(ndc(3.0F, {13, 6, 3}), {1, 1, 1}), 1e-6F) << "a wide one shows more at the sides";
  EXPECT_FLOAT_EQ(focalPixels(camera, {300, 200}), 25.0F) << "pixels per world unit";
  EXPECT_FLOAT_EQ(focalPixels(camera, {200, 200}), 200.0F / 12.0F);
}

TEST(Camera, LooksAlongMinusZWithYUp) {
  const Camera camera = lookAt({3, 4, 5}, {3, 4, -5}, kBox);
  const glm::vec4 up = clipFromWorld(camera, 1.0F) * glm::vec4(3, 5, 0, 1);
  EXPECT_GT(up.y, 0.0F);
  const glm::vec4 right = clipFromWorld(camera, 1.0F) * glm::vec4(4, 4, 0, 1);
  EXPECT_GT(right.x, 0.0F);
  EXPECT_EQ(camera.positionWorld(), glm::vec3(3, 4, 5));
}

TEST(Camera, VerticalViewsWorkAndEqualPointsAreRefused) {
  const Camera down = lookAt({0, 10, 0}, {0, 0, 0}, kBox);
  EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(down.worldFromCamera[2]), glm::vec4(2.0F))));
  EXPECT_THROW(lookAt({1, 2, 3}, {1, 2, 3}, kBox), Error);
}

TEST(Camera, FrameBoxSeesEveryCornerAndFillsTheView) {
  for (const Aabb& box :
       {kBox, Aabb{glm::vec3(-500, -2, -30), glm::vec3(100, 5, 400)}, Aabb{glm::vec3(0), glm::vec3(1e-3F, 1, 0)}}) {
    for (const float aspect : {0.5F, 1.0F, 16.0F / 9.0F}) {
      const Camera camera = frameBox(box, aspect);
      float widest = 0.0F;
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                          (corner & 4) != 0 ? box.max.z : box.min.z);
        const glm::vec4 clip = clipFromWorld(camera, aspect) * glm::vec4(p, 1.0F);
        ASSERT_GT(clip.w, 0.0F);
        widest = std::max({widest, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
      }
      EXPECT_LE(widest, 1.0F);
      EXPECT_GE(widest, 0.8F);
    }
  }
}

asset::Camera recordedPath() {
  asset::Camera camera;
  camera.worldFromParent = glm::translate(glm::dmat4(1.0), {0, 100, 0});
  camera.worldFromCamera = camera.worldFromParent;
  camera.track.translationTimes = {0.0F, 1.0F, 3.0F};
  camera.track.translations = {{0, 0, 0}, {10, 0, 0}, {10, 20, 0}};
  camera.track.rotationTimes = {0.0F, 2.0F};
  camera.track.rotations = {glm::angleAxis(0.0F, glm::vec3(0, 1, 0)), glm::angleAxis(1.0F, glm::vec3(0, 1, 0))};
  return camera;
}

TEST(CameraPath, InterpolatesBetweenKeysAndStopsAtTheEnds) {
  const asset::Camera path = recordedPath();
  EXPECT_EQ(frameCount(path), 91U);
  const auto place = [&](float frame) { return cameraAtFrame(path, frame).positionWorld(); };
  EXPECT_LT(glm::distance(place(0), glm::vec3(0, 100, 0)), 1e-4F);
  EXPECT_LT(glm::distance(place(15), glm::vec3(5, 100, 0)), 1e-4F);
  EXPECT_LT(glm::distance(place(60), glm::vec3(10, 110, 0)), 1e-4F);
  EXPECT_LT(glm::distance(place(5000), glm::vec3(10, 120, 0)), 1e-4F);
  const glm::mat4 halfway = cameraAtFrame(path, 30).worldFromCamera;
  EXPECT_NEAR(std::acos(halfway[0][0]), 0.5F, 1e-4F);
}

TEST(CameraPath, StillCameraIgnoresTheFrame) {
  asset::Camera still;
  still.worldFromCamera = glm::translate(glm::dmat4(1.0), {1, 2, 3});
  EXPECT_EQ(frameCount(still), 1U);
  EXPECT_EQ(cameraAtFrame(still, 77).positionWorld(), glm::vec3(1, 2, 3));
}

}  // namespace
}  // namespace jalousie::scene
