// Bounds of distances to flat faces.
#include "bake/mesh/flat_patches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/mesh/triangle_bvh.h"
#include "core/random.h"

namespace jalousie::bake {
namespace {

struct Faces {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
};

/// A grid of cells in the plane z = x / 2, without the cells that `keeps` refuses.
template <class Keeps>
Faces tiltedGrid(std::uint32_t cells, const Keeps& keeps) {
  Faces faces;
  for (std::uint32_t y = 0; y <= cells; ++y)
    for (std::uint32_t x = 0; x <= cells; ++x)
      faces.positions.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.5F * static_cast<float>(x));
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t i = y * (cells + 1) + x;
      if (keeps(x, y))
        faces.indices.insert(faces.indices.end(), {i, i + 1, i + cells + 2, i, i + cells + 2, i + cells + 1});
    }
  }
  return faces;
}

Faces plate() {
  return tiltedGrid(8, [](std::uint32_t, std::uint32_t) { return true; });
}

/// With a hole in the middle and a notch at the rim.
Faces pierced() {
  return tiltedGrid(8, [](std::uint32_t x, std::uint32_t y) {
    const bool inHole = x >= 3 && x < 5 && y >= 3 && y < 5;
    return !inHole && !(x >= 6 && y == 1);
  });
}

glm::vec3 onPlane(double x, double y) {
  return {x, y, 0.5 * x};
}

constexpr double kRounding = 1e-6;

TEST(FlatPatches, APieceOverManyTrianglesOfAFaceIsInIt) {
  const Faces faces = plate();
  const FlatPatches patches(faces.positions, faces.indices, kRounding);
  ASSERT_EQ(patches.size(), 1U);
  EXPECT_LT(patches.bound(0, {onPlane(0, 0), onPlane(8, 0), onPlane(8, 8)}), 1e-4) << "up to the rim";
  const glm::vec3 lifted(0.0F, 0.0F, 0.25F);
  const double height = 0.25 / std::sqrt(1.25);
  const double bound = patches.bound(5, {onPlane(1, 1), onPlane(5, 2) + lifted, onPlane(2, 6)});
  EXPECT_GE(bound, height);
  EXPECT_LT(bound, height + 1e-4);
  EXPECT_TRUE(std::isinf(patches.bound(0, {onPlane(1, 1), onPlane(8.1, 2), onPlane(2, 6)}))) << "beyond the rim";
}

TEST(FlatPatches, HolesAndNotchesAreNoFace) {
  const Faces faces = pierced();
  const FlatPatches patches(faces.positions, faces.indices, kRounding);
  ASSERT_EQ(patches.size(), 1U);
  EXPECT_TRUE(std::isinf(patches.bound(0, {onPlane(0.5, 0.5), onPlane(7.5, 7), onPlane(1, 7)}))) << "over the hole";
  EXPECT_TRUE(std::isinf(patches.bound(0, {onPlane(3.2, 3.2), onPlane(4.8, 3.2), onPlane(4, 4.8)}))) << "in the hole";
  EXPECT_TRUE(std::isinf(patches.bound(0, {onPlane(5, 0.5), onPlane(7.5, 0.5), onPlane(7.5, 2.5)})))
      << "over the notch";
  EXPECT_LT(patches.bound(0, {onPlane(0.5, 0.5), onPlane(2.9, 0.5), onPlane(2.9, 7.5)}), 1e-4);
}

TEST(FlatPatches, OnlyTrianglesOfOnePlaneThatFaceOneSideAreJoined) {
  Faces faces = plate();
  const auto first = static_cast<std::uint32_t>(faces.positions.size());
  faces.positions.emplace_back(8.0F, 0.0F, 9.0F);
  faces.indices.insert(faces.indices.end(), {8, first, 17});  // stands on the rim
  const FlatPatches patches(faces.positions, faces.indices, kRounding);
  EXPECT_EQ(patches.size(), 1U);
  const auto standing = static_cast<std::uint32_t>(faces.indices.size() / 3 - 1);
  EXPECT_TRUE(std::isinf(patches.bound(standing, {onPlane(1, 1), onPlane(2, 1), onPlane(2, 2)})));
  std::vector<std::uint32_t> turned = {0, 1, 10, 0, 9, 10};  // the second one faces the other side
  EXPECT_EQ(FlatPatches(faces.positions, turned, kRounding).size(), 0U);
}

TEST(FlatPatches, FacesWithManySidesAreLeftOut) {
  const Faces comb = tiltedGrid(64, [](std::uint32_t x, std::uint32_t y) { return y == 0 || x % 2 == 0; });
  EXPECT_EQ(FlatPatches(comb.positions, comb.indices, kRounding).size(), 0U);
}

TEST(FlatPatches, NoPointIsFartherThanTheBound) {
  const Faces faces = pierced();
  const FlatPatches patches(faces.positions, faces.indices, kRounding);
  const TriangleBvh bvh(faces.positions, faces.indices);
  Random random(17);
  int bounded = 0;
  for (int i = 0; i < 20000; ++i) {
    const float size = random.uniform(0.05F, 4.0F);
    const glm::vec2 place(random.uniform(-0.5F, 8.0F), random.uniform(-0.5F, 8.0F));
    std::array<glm::vec3, 3> piece;
    for (glm::vec3& p : piece) {
      p = onPlane(place.x + size * random.uniform(), place.y + size * random.uniform());
      p.z += random.uniform(-0.1F, 0.1F);
      if (i % 3 == 0) p = onPlane(std::round(p.x), std::round(p.y));  // on lines of the grid, and on the rim
    }
    const double bound = patches.bound(0, piece);
    if (std::isinf(bound)) continue;
    ++bounded;
    for (int k = 0; k < 12; ++k) {
      const float root = std::sqrt(random.uniform());
      const float along = random.uniform();
      const glm::vec3 p = (1.0F - root) * piece[0] + root * (1.0F - along) * piece[1] + root * along * piece[2];
      ASSERT_LE(bvh.distance(p), bound + 1e-6) << i;
    }
  }
  EXPECT_GT(bounded, 1000);
}

}  // namespace
}  // namespace jalousie::bake
