// Cells of a mesh: sizes, disjoint boxes, merging for coarser levels, coinciding triangles.
#include "core/cell_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "core/aabb.h"

namespace jalousie {
namespace {

std::vector<glm::vec3> randomPoints(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto coordinate = [&] { return static_cast<float>(random() % 100000U) / 1000.0F; };
  std::vector<glm::vec3> points(count);
  for (glm::vec3& point : points) {
    point.x = coordinate();
    point.y = 0.1F * coordinate();
    point.z = coordinate();
  }
  return points;
}

std::map<std::uint32_t, std::uint32_t> sizesOf(const std::vector<std::uint32_t>& cells) {
  std::map<std::uint32_t, std::uint32_t> sizes;
  for (const std::uint32_t cell : cells)
    ++sizes[cell];
  return sizes;
}

bool overlapInside(const Aabb& a, const Aabb& b) {
  for (int k = 0; k < 3; ++k)
    if (a.max[k] <= b.min[k] || b.max[k] <= a.min[k]) return false;
  return true;
}

TEST(CellTree, CellsAreFullAndDisjoint) {
  const std::vector<glm::vec3> points = randomPoints(10000, 1);
  const CellTree tree(points, 256);
  const std::vector<std::uint32_t> cells = tree.assign(points);
  ASSERT_EQ(tree.cellCount(), 40U);  // 10000 / 256 = 39.06
  const auto sizes = sizesOf(cells);
  ASSERT_EQ(sizes.size(), tree.cellCount());
  for (const auto& [cell, size] : sizes) {
    EXPECT_LE(size, 256U) << cell;
    EXPECT_GE(size, 240U) << cell;
  }
  std::vector<Aabb> boxes(tree.cellCount());
  for (std::size_t i = 0; i < points.size(); ++i)
    boxes[cells[i]].add(points[i]);
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b)
      EXPECT_FALSE(overlapInside(boxes[a], boxes[b])) << a << " and " << b;
}

TEST(CellTree, CoarserLevelsMergeWholeLeaves) {
  const std::vector<glm::vec3> finest = randomPoints(10000, 2);
  const CellTree tree(finest, 256);
  const std::vector<std::uint32_t> leaves = tree.assign(finest);
  for (const std::size_t count : {5000U, 1250U, 300U, 256U, 1U}) {
    const std::vector<glm::vec3> level(finest.begin(), finest.begin() + static_cast<std::ptrdiff_t>(count));
    const std::vector<std::uint32_t> cells = tree.assign(level);
    const auto sizes = sizesOf(cells);
    EXPECT_LE(sizes.size(), std::max<std::size_t>(1, 3 * count / 256)) << count;
    for (const auto& [cell, size] : sizes)
      EXPECT_LE(size, 256U);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_LE(cells[i], leaves[i]) << "a merged cell has the number of its first leaf";
      // All triangles of a leaf go the same way.
      for (std::size_t j = i + 1; j < std::min(count, i + 50); ++j)
        EXPECT_TRUE(leaves[i] != leaves[j] || cells[i] == cells[j]);
    }
  }
}

TEST(CellTree, CoincidingTrianglesStayTogether) {
  const std::vector<glm::vec3> points(1000, glm::vec3(1.0F, 2.0F, 3.0F));
  const CellTree tree(points, 10);
  EXPECT_EQ(tree.cellCount(), 1U);
  EXPECT_EQ(tree.assign(points), std::vector<std::uint32_t>(1000, 0U));
}

TEST(CellTree, ManyEqualCoordinatesAreSplitBetweenTheValues) {
  std::vector<glm::vec3> points(1000, glm::vec3(0.0F));
  points.resize(1010, glm::vec3(1.0F, 0.0F, 0.0F));
  std::shuffle(points.begin(), points.end(), std::mt19937(3));
  const CellTree tree(points, 100);
  ASSERT_EQ(tree.cellCount(), 2U);
  const std::vector<std::uint32_t> cells = tree.assign(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(cells[i], points[i].x > 0.5F ? 1U : 0U);
}

TEST(CellTree, ALineOfTrianglesIsNoDeepRecursion) {
  // Distances that double leave one triangle on one side of each plane in the worst case.
  std::vector<glm::vec3> points;
  float x = 1e-30F;
  for (int i = 0; i < 200; ++i, x *= 1.9F)
    points.emplace_back(x, 0.0F, 0.0F);
  EXPECT_EQ(CellTree(points, 1).cellCount(), 200U);
}

TEST(CellTree, NothingIsOneEmptyCell) {
  const CellTree tree({}, 256);
  EXPECT_EQ(tree.cellCount(), 1U);
  EXPECT_TRUE(tree.assign({}).empty());
  EXPECT_EQ(tree.assign(std::vector<glm::vec3>(3, glm::vec3(0.0F))), std::vector<std::uint32_t>(3, 0U));
}

TEST(CellTree, TheOrderOfTheTrianglesDoesNotMatter) {
  std::vector<glm::vec3> points = randomPoints(3000, 4);
  const std::vector<std::uint32_t> cells = CellTree(points, 64).assign(points);
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  std::vector<glm::vec3> shuffled;
  shuffled.reserve(order.size());
  for (const std::size_t i : order)
    shuffled.push_back(points[i]);
  const std::vector<std::uint32_t> other = CellTree(shuffled, 64).assign(shuffled);
  for (std::size_t i = 0; i < order.size(); ++i)
    ASSERT_EQ(other[i], cells[order[i]]);
}

}  // namespace
}  // namespace jalousie
