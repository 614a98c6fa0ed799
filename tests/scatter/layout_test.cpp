// Placement: count, containment, the object in the middle, rotations, scales, seeds.
#include "scatter/layout.h"

#include <cmath>

#include "scatter/scatter_fixtures.h"

namespace jalousie::scatter {
namespace {

const SourceAsset& ball() {
  static const SourceAsset source = findSourceAsset(test::bakedBall());
  return source;
}

asset::Instances place(const Layout& layout, const SourceAsset& source = ball()) {
  Progress progress("test", 0, true);
  return instancesOf(placeObjects(layout, sideOf(layout, source), progress), source, source.parts.front());
}

glm::vec3 boxCenter(const asset::Instances& instances, std::size_t i) {
  return instances.translations[i] +
         instances.rotations[i] * (instances.scales[i] * ball().parts[0].boxObject.center());
}

Layout cube(std::uint32_t count, float side) {
  Layout layout;
  layout.count = count;
  layout.side = side;
  return layout;
}

TEST(ScatterLayout, BoxCentresFillTheCubeAndStayInside) {
  Layout layout = cube(4000, 10.0F);
  layout.rotation = Rotation::kAny;
  layout.scale = {0.5F, 2.0F};
  const asset::Instances instances = place(layout);
  ASSERT_EQ(instances.translations.size(), 4000U);
  Aabb centers;
  glm::vec3 sum(0.0F);
  for (std::size_t i = 0; i < 4000; ++i) {
    centers.add(boxCenter(instances, i));
    sum += boxCenter(instances, i);
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(centers.min[axis], -5.0F - 1e-4F);
    EXPECT_LE(centers.max[axis], 5.0F + 1e-4F);
    EXPECT_LT(centers.min[axis], -4.9F);
    EXPECT_GT(centers.max[axis], 4.9F);
    EXPECT_NEAR(sum[axis] / 4000.0F, 0.0F, 0.2F);
  }
}

TEST(ScatterLayout, FirstObjectIsInTheMiddle) {
  Layout layout = cube(3, 100.0F);
  layout.rotation = Rotation::kX;
  EXPECT_LT(glm::length(boxCenter(place(layout), 0)), 1e-5F);
}

TEST(ScatterLayout, SameSeedSameNumbersOtherSeedOthers) {
  Layout layout = cube(50, 10.0F);
  layout.rotation = Rotation::kAny;
  EXPECT_EQ(place(layout).translations, place(layout).translations);
  EXPECT_EQ(place(layout).rotations, place(layout).rotations);
  const asset::Instances first = place(layout);
  layout.seed = 2;
  EXPECT_NE(place(layout).translations, first.translations);
}

TEST(ScatterLayout, RotationAboutXKeepsXAndReachesAllAngles) {
  Layout layout = cube(2000, 10.0F);
  layout.rotation = Rotation::kX;
  std::array<int, 4> quadrants{};
  for (const glm::quat& q : place(layout).rotations) {
    EXPECT_NEAR(glm::length(q), 1.0F, 1e-5F);
    EXPECT_NEAR((q * glm::vec3(1, 0, 0)).x, 1.0F, 1e-5F);
    const glm::vec3 up = q * glm::vec3(0, 1, 0);
    ++quadrants[(up.y > 0 ? 1U : 0U) + (up.z > 0 ? 2U : 0U)];
  }
  for (const int count : quadrants)
    EXPECT_NEAR(count, 500, 100);
}

TEST(ScatterLayout, AnyRotationTurnsEveryAxis) {
  Layout layout = cube(2000, 10.0F);
  layout.rotation = Rotation::kAny;
  glm::vec3 sum(0.0F);
  for (const glm::quat& q : place(layout).rotations) {
    EXPECT_NEAR(glm::length(q), 1.0F, 1e-5F);
    sum += q * glm::vec3(1, 0, 0);
  }
  EXPECT_LT(glm::length(sum) / 2000.0F, 0.06F) << "directions are spread over the sphere";
}

TEST(ScatterLayout, ScalesAreUniformAndInRange) {
  Layout layout = cube(1000, 10.0F);
  layout.scale = {0.5F, 1.5F};
  float low = 9.0F;
  float high = 0.0F;
  for (const glm::vec3& s : place(layout).scales) {
    EXPECT_EQ(s.x, s.y);
    EXPECT_EQ(s.x, s.z);
    low = std::min(low, s.x);
    high = std::max(high, s.x);
  }
  EXPECT_GE(low, 0.5F);
  EXPECT_LT(low, 0.52F);
  EXPECT_LE(high, 1.5F);
  EXPECT_GT(high, 1.48F);
}

TEST(ScatterLayout, SideInDiagonalsFollowsTheObject) {
  Layout layout;
  layout.sideDiagonals = 10.0F;
  EXPECT_NEAR(sideOf(layout, ball()), 10.0F * std::sqrt(12.0F), 1e-3F);
  layout.side = 7.0F;
  EXPECT_EQ(sideOf(layout, ball()), 7.0F);
}

TEST(ScatterLayout, TransformOfTheInputNodeIsKept) {
  tinygltf::Model model = test::bakedBall();
  model.nodes[0].scale = {2.0, 2.0, 3.0};
  model.nodes[0].rotation = {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)};
  const SourceAsset source = findSourceAsset(model);
  EXPECT_NEAR(source.diagonal, std::sqrt(16.0F + 16.0F + 36.0F), 1e-4F);
  const asset::Instances instances = place(cube(1, 1.0F), source);
  EXPECT_EQ(instances.scales[0], glm::vec3(2, 2, 3));
  const glm::vec3 turned = instances.rotations[0] * glm::vec3(1, 0, 0);
  EXPECT_NEAR(turned.y, 1.0F, 1e-5F);
}

TEST(ScatterLayout, ShearAndEmptyScenesAreUnsupported) {
  tinygltf::Model sheared = test::bakedBall();
  sheared.nodes[0].matrix = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(test::codeOf([&] { findSourceAsset(sheared); }), ErrorCode::kUnsupported);
  tinygltf::Model flat = test::bakedBall();
  flat.nodes[0].scale = {1, 0, 1};
  EXPECT_EQ(test::codeOf([&] { findSourceAsset(flat); }), ErrorCode::kUnsupported);
  EXPECT_EQ(test::codeOf([&] { findSourceAsset(tinygltf::Model()); }), ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace jalousie::scatter
