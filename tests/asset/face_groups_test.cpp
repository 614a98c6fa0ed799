// Laws of culling volumes and of groups, on random triangles.
#include "asset/face_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "core/random.h"

namespace jalousie::asset {
namespace {

glm::vec3 randomPoint(Random& random, float reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

/// Triangles of a bent patch: normals within a cone of random width.
std::vector<Triangle> randomPatch(Random& random, std::size_t count) {
  const glm::vec3 middle = randomPoint(random, 4.0F);
  const glm::vec3 u = randomPoint(random, 1.0F);
  const glm::vec3 v = randomPoint(random, 1.0F);
  const float bend = std::exp2(random.uniform(-6.0F, 2.0F));
  std::vector<Triangle> triangles;
  while (triangles.size() < count) {
    const glm::vec3 at = middle + randomPoint(random, 1.0F);
    const Triangle triangle{at, at + u + bend * randomPoint(random, 1.0F), at + v + bend * randomPoint(random, 1.0F)};
    if (facetOf(triangle).inradius > 1e-3) triangles.push_back(triangle);
  }
  return triangles;
}

Aabb boundsOf(std::span<const Triangle> triangles) {
  Aabb bounds;
  for (const Triangle& triangle : triangles)
    for (const glm::vec3& corner : triangle)
      bounds.add(corner);
  return bounds;
}

std::vector<Facet> facetsOf(std::span<const Triangle> triangles) {
  std::vector<Facet> facets;
  for (const Triangle& triangle : triangles)
    facets.push_back(facetOf(triangle));
  return facets;
}

/// n.(p - C) of the triangle that is nearest to a front face, and of the one that is farthest from it.
std::pair<double, double> facing(std::span<const Facet> facets, const Eye& eye) {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Facet& facet : facets) {
    const double own = glm::dot(facet.normal, facet.corner * eye.w - glm::dvec3(eye));
    range = {std::min(range.first, own), std::max(range.second, own)};
  }
  return range;
}

Eye randomEye(Random& random) {
  const float reach = std::exp2(random.uniform(0.0F, 6.0F));
  return {glm::dvec3(randomPoint(random, reach)), random.below(4) == 0 ? 0.0 : 1.0};
}

TEST(CullingVolume, SlackIsALowerBoundAndFrontAnUpperOne) {
  Random random(1);
  int culled = 0;
  int front = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::vector<Triangle> triangles = randomPatch(random, 1 + random.below(12));
    const std::vector<Facet> facets = facetsOf(triangles);
    const CullingVolume volume = volumeOf(facets, boundsOf(triangles));
    const Eye eye = randomEye(random);
    const auto [least, most] = facing(facets, eye);
    ASSERT_LE(volume.slack(eye), least + 1e-9);
    culled += volume.slack(eye) > 0.0 ? 1 : 0;
    if (!volume.isFront(eye)) continue;
    ++front;
    ASSERT_LT(most, 1e-9);
  }
  EXPECT_GT(culled, 2000);
  EXPECT_GT(front, 2000);
}

TEST(CullingVolume, OneTriangleIsDecidedExactly) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const std::vector<Triangle> triangles = randomPatch(random, 1);
    const std::vector<Facet> facets = facetsOf(triangles);
    const Eye eye = randomEye(random);
    EXPECT_NEAR(volumeOf(facets, boundsOf(triangles)).slack(eye), facing(facets, eye).first, 1e-6);
  }
}

TEST(CullingVolume, AUnionCullsNothingThatItsPartsWouldNot) {
  Random random(3);
  int culled = 0;
  int wrongByPlainMinimum = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::vector<Triangle> first = randomPatch(random, 4);
    const std::vector<Triangle> second = randomPatch(random, 4);
    const CullingVolume a = volumeOf(facetsOf(first), boundsOf(first));
    const CullingVolume b = volumeOf(facetsOf(second), boundsOf(second));
    const CullingVolume both = unite(a, b, randomPoint(random, 8.0F));
    const Eye eye = randomEye(random);
    const double parts = std::min(a.slack(eye), b.slack(eye));
    ASSERT_LE(both.slack(eye), parts + 1e-9);
    culled += both.slack(eye) > 0.0 ? 1 : 0;
    // The plain minimum of both d holds for a common origin alone.
    CullingVolume plain = both;
    plain.least = std::min(a.least, b.least);
    const double exact = std::min(facing(facetsOf(first), eye).first, facing(facetsOf(second), eye).first);
    wrongByPlainMinimum += plain.slack(eye) > 0.0 && exact < 0.0 ? 1 : 0;
  }
  EXPECT_GT(culled, 100);
  EXPECT_GT(wrongByPlainMinimum, 20);
}

TEST(CullingVolume, TheBestCornerIsAtLeastAsGoodAsTheMiddle) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const std::vector<Triangle> triangles = randomPatch(random, 6);
    const std::vector<Facet> facets = facetsOf(triangles);
    const Aabb bounds = boundsOf(triangles);
    double middle = std::numeric_limits<double>::infinity();
    for (const Facet& facet : facets)
      middle =
          std::min(middle, glm::dot(facet.normal, facet.corner - glm::dvec3(0.5F * bounds.min + 0.5F * bounds.max)));
    EXPECT_GE(volumeOf(facets, bounds).least, middle);
  }
}

TEST(NormalCells, HoldTheirNormalsBetweenTheirLines) {
  Random random(5);
  std::set<std::uint32_t> numbers;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 normal = randomPoint(random, 1.0F);
    const NormalCell cell = normalCell(glm::dvec3(normal));
    const int axis = static_cast<int>(cell.side / 2);
    ASSERT_EQ(normal[axis] < 0.0F, cell.side % 2 == 1);
    const double major = std::abs(double{normal[axis]});
    for (int k = 0; k < 3; ++k)
      ASSERT_LE(std::abs(double{normal[k]}), major);
    const auto line = [&](int k) { return 8.0 * (normal[(axis + k) % 3] / major + 1.0); };
    ASSERT_LE(cell.column, line(1));
    ASSERT_LE(line(1), cell.column + 1.0);
    ASSERT_LE(cell.row, line(2));
    ASSERT_LE(line(2), cell.row + 1.0);
    numbers.insert(cell.number());
  }
  EXPECT_EQ(numbers.size(), 6U * 16 * 16) << "cells have different numbers, and all are met";
  EXPECT_EQ(*numbers.rbegin(), 6U * 16 * 16 - 1);
}

/// A sphere of separate triangles, with some thin ones.
std::vector<Triangle> ball(std::uint32_t rings, std::uint32_t thin) {
  const auto at = [&](std::uint32_t ring, std::uint32_t k) {
    const double polar = 3.14159265 * ring / rings;
    const double around = 3.14159265 * k / rings;
    return glm::vec3(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
  };
  std::vector<Triangle> triangles;
  for (std::uint32_t ring = 1; ring < rings; ++ring)
    for (std::uint32_t k = 0; k < 2 * rings; ++k)
      triangles.push_back({at(ring, k), at(ring + 1, k), at(ring, k + 1)});
  for (std::uint32_t i = 0; i < thin; ++i)
    triangles.insert(triangles.begin() + 3 * i, {at(1, i), at(2, i), 0.5F * (at(1, i) + at(2, i))});
  return triangles;
}

TEST(FaceGroups, AreAPermutationInWholeTrees) {
  const std::vector<Triangle> triangles = ball(24, 7);
  for (const FaceGrouping grouping : {FaceGrouping::kMasks, FaceGrouping::kClusters, FaceGrouping::kMeshlets}) {
    const FaceOrder order = groupFaces(triangles, boundsOf(triangles), grouping);
    std::vector<std::uint32_t> sorted = order.triangles;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(sorted, all);
    EXPECT_EQ(faceTriangles(order.tree), triangles.size());
    std::size_t at = 0;
    for (const std::uint32_t number : order.tree) {
      EXPECT_TRUE(std::is_sorted(order.triangles.begin() + static_cast<std::ptrdiff_t>(at),
                                 order.triangles.begin() + static_cast<std::ptrdiff_t>(at + number)))
          << "the order for the vertex cache is kept within a group";
      at += number;
    }
    EXPECT_EQ(order.tree.back(), 7U) << "thin triangles are a group of their own";
    const FaceOrder again = groupFaces(triangles, boundsOf(triangles), grouping);
    EXPECT_EQ(again.triangles, order.triangles);
    EXPECT_EQ(again.tree, order.tree);
  }
}

TEST(FaceGroups, OfMasksHaveOneCellEach) {
  const std::vector<Triangle> triangles = ball(24, 0);
  const FaceOrder order = groupFaces(triangles, boundsOf(triangles), FaceGrouping::kMasks);
  std::size_t at = 0;
  std::set<std::uint32_t> seen;
  for (const std::uint32_t number : order.tree) {
    ASSERT_GT(number, 0U) << "masks have no tree";
    const std::uint32_t cell = normalCell(facetOf(triangles[order.triangles[at]]).normal).number();
    EXPECT_TRUE(seen.insert(cell).second);
    for (std::uint32_t k = 0; k < number; ++k)
      ASSERT_EQ(normalCell(facetOf(triangles[order.triangles[at + k]]).normal).number(), cell);
    at += number;
  }
}

TEST(FaceGroups, ClustersCostLessThanOneGroup) {
  const std::vector<Triangle> triangles = ball(32, 0);
  const Aabb bounds = boundsOf(triangles);
  const FaceOrder order = groupFaces(triangles, bounds, FaceGrouping::kClusters);
  Random random(6);
  double cost = 0.0;
  const int eyes = 200;
  for (int i = 0; i < eyes; ++i) {
    const Eye eye(glm::dvec3(randomPoint(random, 3.0F)), 1.0);
    std::size_t at = 0;
    for (const std::uint32_t number : order.tree) {
      if (number == 0) continue;
      std::vector<Triangle> group;
      for (std::uint32_t k = 0; k < number; ++k)
        group.push_back(triangles[order.triangles[at + k]]);
      at += number;
      cost += kFaceTestCost + (volumeOf(facetsOf(group), boundsOf(group)).slack(eye) > 0.0 ? 0.0 : number);
    }
  }
  EXPECT_LT(cost / eyes, 0.85 * static_cast<double>(triangles.size())) << "tests included";
}

TEST(FaceGroups, OfNothingAndOfThinTrianglesAlone) {
  EXPECT_TRUE(groupFaces({}, {}, FaceGrouping::kClusters).tree.empty());
  const glm::vec3 p(1.0F);
  const std::vector<Triangle> flat(5, Triangle{p, p, p});
  for (const FaceGrouping grouping : {FaceGrouping::kMasks, FaceGrouping::kClusters, FaceGrouping::kMeshlets})
    EXPECT_EQ(groupFaces(flat, boundsOf(flat), grouping).tree, FaceTree{5});
}

TEST(FaceTrees, AreCompleteOrNot) {
  EXPECT_EQ(faceTriangles(FaceTree{}), 0U);
  EXPECT_EQ(faceTriangles(FaceTree{5}), 5U);
  EXPECT_EQ(faceTriangles(FaceTree{0, 2, 0, 3, 4, 7}), 16U);
  for (const FaceTree& broken : {FaceTree{0}, FaceTree{0, 1}, FaceTree{1, 0, 0, 1, 1}})
    EXPECT_EQ(faceTriangles(broken), std::nullopt);
}

TEST(FaceTrees, SplitAtTheEndsOfCells) {
  const FaceTree tree{0, 2, 3, 4, 0, 0, 1, 1, 5};
  using Trees = std::vector<FaceTree>;
  EXPECT_EQ(splitFaceTrees(tree, std::vector<std::uint32_t>{5, 5, 9, 16}),
            (Trees{{0, 2, 3}, {}, {4}, {0, 0, 1, 1, 5}}));
  EXPECT_EQ(splitFaceTrees(tree, std::vector<std::uint32_t>{16}), (Trees{tree}));
  for (const std::vector<std::uint32_t>& ends : {std::vector<std::uint32_t>{2, 16}, {5, 10, 16}, {9}, {}})
    EXPECT_EQ(splitFaceTrees(tree, ends), std::nullopt);
}

}  // namespace
}  // namespace jalousie::asset
