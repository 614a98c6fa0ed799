// Measured distances against brute force and against spheres of known size.
#include "bake/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/bake_fixtures.h"
#include "core/random.h"

namespace jalousie::bake {
namespace {

TEST(TriangleBvh, EqualsBruteForceOnRandomAndDegenerateTriangles) {
  Random random(4);
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  const auto point = [&](float size) {
    return glm::vec3(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
  };
  for (std::uint32_t t = 0; t < 300; ++t) {
    const glm::vec3 center = point(5);
    positions.push_back(center + point(1));
    positions.push_back(t % 7 == 0 ? positions.back() : center + point(1));
    positions.push_back(t % 11 == 0 ? 2.0F * positions[positions.size() - 1] - positions[positions.size() - 2]
                                    : center + point(1));
    for (std::uint32_t k = 0; k < 3; ++k)
      indices.push_back(3 * t + k);
  }
  const TriangleBvh bvh(positions, indices);
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 p = point(8);
    double best = 1e30;
    for (std::size_t t = 0; t < indices.size(); t += 3)
      best = std::min(best, squaredDistanceToTriangle(p, positions[t], positions[t + 1], positions[t + 2]));
    ASSERT_NEAR(bvh.distance(p), std::sqrt(best), 1e-6 * (1.0 + std::sqrt(best)));
  }
}

TEST(TriangleDistance, FaceEdgeAndCornerAreTheNearestInTurn) {
  const glm::dvec3 a(0, 0, 0);
  const glm::dvec3 b(2, 0, 0);
  const glm::dvec3 c(0, 2, 0);
  EXPECT_NEAR(squaredDistanceToTriangle({0.5, 0.5, 3}, a, b, c), 9.0, 1e-12);
  EXPECT_NEAR(squaredDistanceToTriangle({1, -2, 0}, a, b, c), 4.0, 1e-12);
  EXPECT_NEAR(squaredDistanceToTriangle({-3, -4, 0}, a, b, c), 25.0, 1e-12);
}

TEST(Deviation, OfConcentricSpheresIsTheDifferenceOfTheirRadii) {
  asset::Primitive outer = test::sphere(96, 64);
  asset::Primitive inner = outer;
  for (glm::vec3& p : inner.positions)
    p *= 0.9F;
  const DeviationMeter meter({outer.positions, outer.indices}, 5000);
  const Deviation deviation = meter.measure({inner.positions, inner.indices});
  EXPECT_NEAR(deviation.max, 0.1, 0.003);
  EXPECT_NEAR(deviation.mean, 0.1, 0.003);
  EXPECT_NEAR(meter.measure({outer.positions, outer.indices}).max, 0.0, 1e-6);
}

TEST(Deviation, SeesWhatOnlyTheOriginalHas) {
  asset::Primitive whole = test::sphere(32, 16);
  asset::Primitive half = whole;
  half.indices.resize(half.indices.size() / 2);  // one-sided distance from the half to the whole is zero
  const Deviation deviation =
      DeviationMeter({whole.positions, whole.indices}, 2000).measure({half.positions, half.indices});
  EXPECT_GT(deviation.max, 0.5);
}

}  // namespace
}  // namespace jalousie::bake
