// Compares measured distances with brute force and with spheres of known size.
#include "bake/simplify/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/bake_fixtures.h"
#include "bake/simplify/chain.h"
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

TEST(TriangleBvh, SeedsDoNotChangeTheResult) {
  const WedgeMesh mesh = test::wedges(test::sphere(40, 20));
  const TriangleBvh bvh(mesh.positions, vertexIndices(mesh));
  Random random(8);
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 p(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
    const std::uint32_t seed = random.below(mesh.triangles());
    ASSERT_NEAR(bvh.distance(p, seed), bvh.distance(p), 1e-6);
  }
}

MeterOptions quick(std::uint32_t samples) {
  return {samples, 20000};
}

TEST(Deviation, OfConcentricSpheresIsTheDifferenceOfTheirRadii) {
  const WedgeMesh outer = test::wedges(test::sphere(96, 64));
  WedgeMesh inner = outer;
  for (glm::vec3& p : inner.positions)
    p *= 0.9F;
  const DeviationMeter meter(outer, quick(5000));
  const Deviation deviation = meter.measure(inner);
  EXPECT_NEAR(deviation.twoSided.max, 0.1, 0.006);
  EXPECT_NEAR(deviation.twoSided.mean, 0.1, 0.003);
  EXPECT_LT(deviation.normalDegrees.p95, 2.0);
  EXPECT_NEAR(meter.measure(outer).twoSided.max, 0.0, 1e-6);
}

TEST(Deviation, SeesWhatOnlyTheOriginalHas) {
  const WedgeMesh whole = test::wedges(test::sphere(32, 16));
  WedgeMesh half = whole;
  half.corners.resize(half.corners.size() / 6 * 3);
  const Deviation deviation = DeviationMeter(whole, quick(2000)).measure(half);
  EXPECT_GT(deviation.fromOriginal.max, 0.5);
  EXPECT_LT(deviation.toOriginal.max, 1e-5);
  EXPECT_EQ(deviation.twoSided.max, deviation.fromOriginal.max);
}

TEST(Deviation, TurnedNormalsAndMovedTextureAreMeasured) {
  const WedgeMesh flat = makeWedges(test::combinedTextured(test::grid(4)));
  WedgeMesh changed = flat;
  const double angle = 0.3;
  for (std::uint32_t w = 0; w < changed.vertexOf.size(); ++w) {
    float* values = &changed.attributes[std::size_t{w} * changed.stride];
    const float* normal = values + changed.slot("NORMAL")->offset;
    ASSERT_EQ(normal[2], 1.0F);
    values[changed.slot("NORMAL")->offset] = static_cast<float>(std::sin(angle));
    values[changed.slot("NORMAL")->offset + 2] = static_cast<float>(std::cos(angle));
    values[changed.slot("TEXCOORD_0")->offset] += 0.25F;
  }
  const Deviation deviation = DeviationMeter(flat, quick(2000)).measure(changed);
  EXPECT_NEAR(deviation.normalDegrees.mean, angle * 180.0 / 3.14159265, 1e-3);
  EXPECT_NEAR(deviation.normalDegrees.p95, angle * 180.0 / 3.14159265, 1e-3);
  EXPECT_NEAR(deviation.uv.mean, 0.25, 1e-5);
  EXPECT_NEAR(deviation.twoSided.max, 0.0, 1e-6);
}

/// Largest distance of many random points of one mesh to another, by brute sampling.
double sampledMaximum(const WedgeMesh& from, const WedgeMesh& to, std::uint64_t seed) {
  const TriangleBvh bvh(to.positions, vertexIndices(to));
  Random random(seed);
  double largest = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const float root = std::sqrt(random.uniform());
    const float r = random.uniform();
    const std::uint32_t t = random.below(from.triangles());
    largest = std::max(largest, bvh.distance(positionAt(from, t, {1.0F - root, root * (1.0F - r), root * r})));
  }
  return largest;
}

TEST(Deviation, NoRandomPointIsFurtherThanTheMaximum) {
  const WedgeMesh original = test::wedges(test::sphere(64, 32));
  ChainOptions options;
  options.samples = 1000;  // the bounds have to do the work
  for (const ChainLevel& level : makeChain(original, options).levels) {
    const double slack = 1e-6;
    EXPECT_LE(sampledMaximum(level.mesh, original, 1), level.deviation.toOriginal.max + slack);
    EXPECT_LE(sampledMaximum(original, level.mesh, 2), level.deviation.fromOriginal.max + slack);
  }
}

class AtEveryScale : public testing::TestWithParam<Preset> {};
INSTANTIATE_TEST_SUITE_P(Presets, AtEveryScale, testing::Values(Preset::kBest, Preset::kFast, Preset::kDraft));

TEST_P(AtEveryScale, TheStoredMaximumIsTheSameShareOfTheDiagonal) {
  // Squares of squares of these lengths are out of the range of single precision.
  asset::Primitive source = test::sphere(64, 32);
  ChainOptions options;
  options.preset = GetParam();
  const LevelChain unit = makeChain(test::wedges(source), options);
  ASSERT_GE(unit.levels.size(), 6U);
  for (const int exponent : {-30, -20, 23, 40}) {  // 1e-9, 1e-6, a planet, 1e12
    const float scale = std::ldexp(1.0F, exponent);
    asset::Primitive scaled = source;
    for (glm::vec3& p : scaled.positions)
      p *= scale;
    const LevelChain chain = makeChain(test::wedges(scaled), options);
    ASSERT_EQ(chain.levels.size(), unit.levels.size()) << scale;
    for (std::size_t k = 1; k < 6; ++k) {
      EXPECT_NEAR(chain.levels[k].errorMax / scale, unit.levels[k].errorMax, 1e-4 * unit.levels[k].errorMax)
          << scale << " level " << k;
    }
  }
}

TEST(TriangleBvh, FindsTheNearestPointAtEveryScale) {
  for (const float scale : {1e-12F, 1e-9F, 1e9F, 1e15F}) {
    asset::Primitive source = test::sphere(40, 20);
    for (glm::vec3& p : source.positions)
      p *= scale;
    const TriangleBvh bvh(source.positions, source.indices);
    Random random(11);
    for (int i = 0; i < 200; ++i) {
      const glm::vec3 direction =
          glm::normalize(glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1) + 1e-3F));
      ASSERT_NEAR(bvh.distance(2.0F * scale * direction) / scale, 1.0, 0.02) << scale;
    }
  }
}

}  // namespace
}  // namespace jalousie::bake
