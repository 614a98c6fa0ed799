// The camera path: length, continuity, and the objects in view.
#include "scatter/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scatter/occluder.h"

namespace jalousie::scatter {
namespace {

constexpr PathSubject kCube{10.0F, 1.0F, false};
constexpr PathSubject kCubeBehind{10.0F, 1.0F, true};
constexpr PathSubject kSingle{0.0F, 1.0F, false};
constexpr PathSubject kSingleBehind{0.0F, 1.0F, true};

struct EyePose {
  glm::vec3 position;
  glm::quat rotation;
  glm::vec3 direction() const { return rotation * glm::vec3(0, 0, -1); }
};

/// The pose at a frame, interpolated as glTF says.
EyePose poseAt(const CameraPath& path, float frame) {
  const float time = frame / static_cast<float>(kFramesPerSecond);
  const auto upper = std::upper_bound(path.times.begin(), path.times.end(), time);
  const auto second = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(upper - path.times.begin(), 1, static_cast<std::ptrdiff_t>(path.times.size()) - 1));
  const float weight = (time - path.times[second - 1]) / (path.times[second] - path.times[second - 1]);
  return {glm::mix(path.positions[second - 1], path.positions[second], weight),
          glm::slerp(path.rotations[second - 1], path.rotations[second], weight)};
}

class EveryPath : public testing::TestWithParam<PathSubject> {};

TEST_P(EveryPath, HasEighteenHundredFramesInFewKeys) {
  const CameraPath path = makeCameraPath(GetParam());
  ASSERT_EQ(path.times.size(), path.positions.size());
  ASSERT_EQ(path.times.size(), path.rotations.size());
  EXPECT_EQ(path.times.front(), 0.0F);
  EXPECT_NEAR(path.times.back() * 30.0F, 1799.0F, 1e-3F);
  EXPECT_LT(path.times.size(), 200U);
  EXPECT_TRUE(std::is_sorted(path.times.begin(), path.times.end()));
}

TEST_P(EveryPath, MovesAndTurnsWithoutJumps) {
  const CameraPath path = makeCameraPath(GetParam());
  const float step = 0.05F * outsideDistance(GetParam());
  for (std::size_t i = 0; i < path.times.size(); ++i) {
    EXPECT_NEAR(glm::length(path.rotations[i]), 1.0F, 1e-5F);
    EXPECT_NEAR((path.rotations[i] * glm::vec3(1, 0, 0)).y, 0.0F, 1e-5F) << "the horizon stays level";
    if (i == 0) continue;
    EXPECT_GT(glm::dot(path.rotations[i - 1], path.rotations[i]), 0.99F) << "key " << i;
    EXPECT_LT(glm::distance(path.positions[i - 1], path.positions[i]), 2.0F * step) << "key " << i;
  }
}

TEST_P(EveryPath, FirstFrameLooksAtTheMiddleFromTheFront) {
  const EyePose pose = poseAt(makeCameraPath(GetParam()), 0.0F);
  EXPECT_NEAR(pose.position.x, 0.0F, 1e-4F);
  EXPECT_GT(pose.position.z, 0.0F);
  EXPECT_NEAR(glm::dot(pose.direction(), -glm::normalize(pose.position)), 1.0F, 1e-5F);
}

INSTANTIATE_TEST_SUITE_P(All, EveryPath, testing::Values(kCube, kCubeBehind, kSingle, kSingleBehind));

TEST(CameraPath, OutsideEverythingIsInView) {
  for (const PathSubject& subject : {kCube, kCubeBehind}) {
    const CameraPath path = makeCameraPath(subject);
    const float half = subject.halfSide + subject.objectRadius;
    const float tangent = std::tan(0.5F * kFovY);
    float tightest = 0.0F;
    for (float frame = 0.0F; frame <= 900.0F; frame += 1.0F) {
      const EyePose pose = poseAt(path, frame);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) != 0 ? half : -half, (corner & 2) != 0 ? half : -half,
                          (corner & 4) != 0 ? half : -half);
        const glm::vec3 view = glm::inverse(pose.rotation) * (p - pose.position);
        ASSERT_LT(view.z, 0.0F);
        const float extent = std::max(std::abs(view.x), std::abs(view.y)) / (-view.z * tangent);
        tightest = std::max(tightest, extent);
      }
    }
    EXPECT_LE(tightest, 1.0F);
    EXPECT_GT(tightest, 0.9F) << "not farther away than needed";
  }
}

TEST(CameraPath, InsideStaysInTheCubeAndLooksAlong) {
  const CameraPath path = makeCameraPath(kCube);
  for (float frame = 1200.0F; frame < 1799.0F; frame += 1.0F) {
    const EyePose pose = poseAt(path, frame);
    EXPECT_LT(glm::length(pose.position), 10.0F);
    EXPECT_GT(glm::length(pose.position), 1.0F);
    const glm::vec3 along = glm::normalize(poseAt(path, frame + 1.0F).position - pose.position);
    EXPECT_GT(glm::dot(pose.direction(), along), 0.8F);
    EXPECT_LT(glm::dot(pose.direction(), glm::normalize(pose.position)), -0.3F) << "turned inward";
  }
}

TEST(CameraPath, GoesOnceAroundOutsideAndInside) {
  const CameraPath path = makeCameraPath(kCube);
  EXPECT_LT(glm::distance(poseAt(path, 0.0F).position, poseAt(path, 900.0F).position), 0.01F);
  const glm::vec3 quarter = poseAt(path, 225.0F).position;
  EXPECT_GT(quarter.x, 10.0F);
  EXPECT_LT(glm::dot(poseAt(path, 1200.0F).position, poseAt(path, 1500.0F).position), 0.0F);
}

TEST(CameraPath, ApproachMissesTheOccluder) {
  const CameraPath path = makeCameraPath(kCubeBehind);
  const OccluderPlace place = placeOccluder(kCubeBehind);
  for (float frame = 0.0F; frame < 1799.0F; frame += 1.0F) {
    const glm::vec3 a = poseAt(path, frame).position;
    const glm::vec3 b = poseAt(path, frame + 1.0F).position;
    if ((a.z - place.distance) * (b.z - place.distance) > 0.0F) continue;
    EXPECT_GT(std::max(std::abs(a.x), std::abs(a.y)), place.halfSize) << "frame " << frame;
  }
}

TEST(CameraPath, SingleObjectBehindAnOccluderIsSeenFromTheFrontOnly) {
  const CameraPath path = makeCameraPath(kSingleBehind);
  const OccluderPlace place = placeOccluder(kSingleBehind);
  for (const glm::vec3& position : path.positions)
    EXPECT_GT(position.z, place.distance);
}

}  // namespace
}  // namespace jalousie::scatter
