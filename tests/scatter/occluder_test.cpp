// Occluders: covered share, holes of the right kind, place, determinism.
#include "scatter/occluder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace jalousie::scatter {
namespace {

constexpr float kHalf = 5.0F;
constexpr int kSamples = 2000;  // per side; 50 in each of the grid's cells

float edge(const glm::vec3& a, const glm::vec3& b, const glm::vec2& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Which of kSamples^2 points of the square are covered, seen from +z.
std::vector<bool> coverMask(const PlainMesh& mesh) {
  std::vector<bool> mask(kSamples * kSamples, false);
  const float cell = 2.0F * kHalf / kSamples;
  const auto firstSample = [&](float x) { return std::clamp(static_cast<int>((x + kHalf) / cell) - 1, 0, kSamples); };
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::vec3& a = mesh.positions[mesh.indices[t]];
    const glm::vec3& b = mesh.positions[mesh.indices[t + 1]];
    const glm::vec3& c = mesh.positions[mesh.indices[t + 2]];
    const int x1 = std::min(firstSample(std::max({a.x, b.x, c.x})) + 3, kSamples);
    const int y1 = std::min(firstSample(std::max({a.y, b.y, c.y})) + 3, kSamples);
    for (int y = firstSample(std::min({a.y, b.y, c.y})); y < y1; ++y) {
      for (int x = firstSample(std::min({a.x, b.x, c.x})); x < x1; ++x) {
        const glm::vec2 p(-kHalf + (static_cast<float>(x) + 0.5F) * cell,
                          -kHalf + (static_cast<float>(y) + 0.5F) * cell);
        const float e0 = edge(a, b, p);
        const float e1 = edge(b, c, p);
        const float e2 = edge(c, a, p);
        const bool inside = (e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0);
        const bool sideways = e0 == 0 && e1 == 0 && e2 == 0;
        if (inside && !sideways) mask[static_cast<std::size_t>(y * kSamples + x)] = true;
      }
    }
  }
  return mask;
}

double covered(const std::vector<bool>& mask) {
  return static_cast<double>(std::count(mask.begin(), mask.end(), true)) / static_cast<double>(mask.size());
}

/// Changes between covered and open along two rows that cross the holes of the grid.
int transitions(const std::vector<bool>& mask) {
  int changes = 0;
  for (const int row : {1025, 625}) {
    for (int x = 1; x < kSamples; ++x) {
      const auto at = static_cast<std::size_t>(row * kSamples + x);
      changes += mask[at] != mask[at - 1] ? 1 : 0;
    }
  }
  return changes;
}

class EveryOccluder : public testing::TestWithParam<OccluderKind> {};

TEST_P(EveryOccluder, CoversTheShareAskedFor) {
  const double tolerance = GetParam() == OccluderKind::kFoliage ? 0.04 : 0.03;
  for (const float cover : {0.25F, 0.5F, 0.75F, 0.9F})
    EXPECT_NEAR(covered(coverMask(makeOccluder({GetParam(), cover}, kHalf, 1))), static_cast<double>(cover), tolerance)
        << cover;
}

TEST_P(EveryOccluder, ExtremesAreOpenAndClosed) {
  EXPECT_TRUE(makeOccluder({GetParam(), 0.0F}, kHalf, 1).indices.empty());
  EXPECT_GT(covered(coverMask(makeOccluder({GetParam(), 1.0F}, kHalf, 1))), 0.97);
}

TEST_P(EveryOccluder, IsWellFormedGeometry) {
  const PlainMesh mesh = makeOccluder({GetParam(), 0.75F}, kHalf, 1);
  ASSERT_EQ(mesh.positions.size(), mesh.normals.size());
  ASSERT_EQ(mesh.indices.size() % 3, 0U);
  EXPECT_LT(mesh.indices.size() / 3, 40'000U);
  const float reach = GetParam() == OccluderKind::kFoliage ? 1.1F * kHalf : kHalf * 1.0001F;
  for (const glm::vec3& p : mesh.positions) {
    EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), reach);
    EXPECT_LE(std::abs(p.z), 0.2F * kHalf);
  }
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::vec3& a = mesh.positions.at(mesh.indices[t]);
    const glm::vec3 normal =
        glm::cross(mesh.positions.at(mesh.indices[t + 1]) - a, mesh.positions.at(mesh.indices[t + 2]) - a);
    ASSERT_GT(glm::length(normal), 0.0F);
    EXPECT_GT(glm::dot(glm::normalize(normal), mesh.normals[mesh.indices[t]]), 0.99F);
  }
}

TEST_P(EveryOccluder, SameSeedSameGeometry) {
  const Occluder occluder{GetParam(), 0.6F};
  EXPECT_EQ(makeOccluder(occluder, kHalf, 3).positions, makeOccluder(occluder, kHalf, 3).positions);
  const bool random = GetParam() == OccluderKind::kFoliage;
  EXPECT_EQ(makeOccluder(occluder, kHalf, 3).positions != makeOccluder(occluder, kHalf, 4).positions, random);
}

INSTANTIATE_TEST_SUITE_P(All, EveryOccluder,
                         testing::Values(OccluderKind::kFoliage, OccluderKind::kGrid, OccluderKind::kFence,
                                         OccluderKind::kPlane),
                         [](const auto& test) { return std::string(occluderName(test.param)); });

TEST(Occluder, HolesAreSmallOrLargeByKind) {
  const auto changes = [](OccluderKind kind) { return transitions(coverMask(makeOccluder({kind, 0.75F}, kHalf, 1))); };
  EXPECT_GT(changes(OccluderKind::kFoliage), 40);
  EXPECT_GT(changes(OccluderKind::kGrid), 70);
  EXPECT_EQ(changes(OccluderKind::kFence), 40);
  EXPECT_EQ(changes(OccluderKind::kPlane), 4);
}

TEST(Occluder, HoleOfTheWallIsInTheMiddle) {
  const std::vector<bool> mask = coverMask(makeOccluder({OccluderKind::kPlane, 0.75F}, kHalf, 1));
  EXPECT_FALSE(mask[kSamples / 2 * kSamples + kSamples / 2]);
  EXPECT_TRUE(mask[0]);
}

TEST(Occluder, StandsBetweenEyeAndObjects) {
  for (const PathSubject& subject : {PathSubject{0.0F, 1.0F, true}, PathSubject{10.0F, 1.0F, true}}) {
    const OccluderPlace place = placeOccluder(subject);
    const float extent = subject.halfSide + subject.objectRadius;
    EXPECT_GT(place.distance - 0.2F * place.halfSize, extent * 1.02F);
    for (const glm::vec3& eye : eyesBehindOccluder(subject)) {
      EXPECT_GT(eye.z, place.distance + 0.2F * place.halfSize);
      const glm::vec3 corner(extent, extent, extent);
      const glm::vec3 hit = glm::mix(corner, eye, (place.distance - corner.z) / (eye.z - corner.z));
      EXPECT_LT(std::max(std::abs(hit.x), std::abs(hit.y)), place.halfSize);
    }
  }
}

}  // namespace
}  // namespace jalousie::scatter
