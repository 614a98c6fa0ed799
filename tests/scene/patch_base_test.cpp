// Normals, bounds and counts of the tessellation path.
#include "scene/patch_base.h"

#include <gtest/gtest.h>

#include <array>

#include "core/random.h"
#include "support/scenes.h"

namespace jalousie::scene {
namespace {

/// Unshares all vertices, as a flat-shaded file does.
asset::Primitive exploded(const asset::Primitive& source) {
  asset::Primitive result;
  for (const std::uint32_t index : source.indices) {
    result.indices.push_back(static_cast<std::uint32_t>(result.positions.size()));
    result.positions.push_back(source.positions[index]);
  }
  return result;
}

TEST(PatchBase, NormalsAgreeWhereverPositionsDo) {
  const asset::Primitive mesh = exploded(test::box({1, 2, 3}));
  const std::vector<glm::vec3> normals = averagedNormals(mesh.positions, mesh.indices);
  for (std::size_t a = 0; a < normals.size(); ++a) {
    EXPECT_NEAR(glm::length(normals[a]), 1.0F, 1e-6F);
    EXPECT_GT(glm::dot(normals[a], mesh.positions[a]), 0.0F) << "points inwards";
    for (std::size_t b = 0; b < a; ++b) {
      if (mesh.positions[a] == mesh.positions[b]) {
        EXPECT_EQ(normals[a], normals[b]);
      }
    }
  }
}

TEST(PatchBase, SphereNormalsAreRadial) {
  const asset::Primitive mesh = test::sphere(32, 16);
  const std::vector<glm::vec3> normals = averagedNormals(mesh.positions, mesh.indices);
  for (std::size_t v = 0; v < normals.size(); ++v)
    EXPECT_GT(glm::dot(normals[v], mesh.positions[v]), 0.99F);
}

TEST(PatchBase, DegenerateTrianglesAndLonelyPointsGetAUnitNormal) {
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
  for (const glm::vec3& normal : averagedNormals(positions, std::vector<std::uint32_t>{0, 1, 2}))
    EXPECT_EQ(normal, glm::vec3(0, 1, 0));
}

TEST(PatchBase, PhongKeepsCornersAndPullsOutwards) {
  const std::array<glm::vec3, 3> corners = {glm::vec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < 3; ++k) {
    glm::vec3 b(0.0F);
    b[k] = 1.0F;
    EXPECT_LT(glm::distance(phongPoint(b, corners, corners, kPhongAlpha), corners[static_cast<std::size_t>(k)]), 1e-6F);
  }
  const glm::vec3 middle = phongPoint(glm::vec3(1.0F / 3.0F), corners, corners, kPhongAlpha);
  EXPECT_GT(glm::length(middle), glm::length(glm::vec3(1.0F / 3.0F)) + 0.1F);
}

TEST(PatchBase, BoundsHoldTheWholeCurvedSurface) {
  Random random(5);
  const auto point = [&] { return glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
  for (int i = 0; i < 500; ++i) {
    const std::array<glm::vec3, 3> corners = {point(), point(), point()};
    const std::array<glm::vec3, 3> normals = {glm::normalize(point()), glm::normalize(point()),
                                              glm::normalize(point())};
    const Aabb box = phongBounds(corners, normals, std::vector<std::uint32_t>{0, 1, 2}, kPhongAlpha);
    for (int k = 0; k < 200; ++k) {
      float u = random.uniform();
      float v = random.uniform();
      if (u + v > 1.0F) u = 1.0F - u, v = 1.0F - v;
      const glm::vec3 p = phongPoint({u, v, 1.0F - u - v}, corners, normals, kPhongAlpha);
      ASSERT_TRUE(glm::all(glm::greaterThanEqual(p, box.min - 1e-5F)) &&
                  glm::all(glm::lessThanEqual(p, box.max + 1e-5F)));
    }
  }
}

TEST(PatchBase, TriangleCountsOfEqualSpacing) {
  EXPECT_EQ(tessellatedTriangles(1), 1U);
  EXPECT_EQ(tessellatedTriangles(2), 6U);
  EXPECT_EQ(tessellatedTriangles(3), 13U);
  EXPECT_EQ(tessellatedTriangles(4), 24U);
  EXPECT_EQ(tessellatedTriangles(20), 600U);
  EXPECT_EQ(98U * tessellatedTriangles(20), 58800U);
}

}  // namespace
}  // namespace jalousie::scene
