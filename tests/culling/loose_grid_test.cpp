// Laws of the loose grid and of eye-siding.
#include "culling/loose_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace jalousie::culling {
namespace {

std::vector<Aabb> gridBoxes(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 low(random.uniform(-30, 30), random.uniform(-3, 3), random.uniform(-30, 30));
    boxes.push_back({low, low + std::exp2(-random.uniform(-3.0F, 6.0F)) * glm::vec3(random.uniform(), 1, 0.5F)});
  }
  return boxes;
}

void expectLaws(const LooseGrid& grid, const std::vector<Aabb>& boxes) {
  std::vector<std::uint32_t> sorted = grid.tree.objects;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted.size(), boxes.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i)
    ASSERT_EQ(sorted[i], i) << "one voxel an object";
  std::uint32_t next = 0;
  for (std::uint32_t n = 0; n < grid.tree.nodes.size(); ++n) {
    const HierarchyNode& node = grid.tree.nodes[n];
    if (node.parent != kNoParent) {
      const HierarchyNode& parent = grid.tree.nodes[node.parent];
      EXPECT_TRUE(glm::all(glm::lessThanEqual(parent.boundsWorld.min, node.boundsWorld.min)));
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(parent.boundsWorld.max, node.boundsWorld.max)));
      EXPECT_GE(node.firstObject, parent.firstObject);
      EXPECT_LE(node.firstObject + node.objectCount, parent.firstObject + parent.objectCount);
      EXPECT_LT(node.objectCount, parent.objectCount) << "every child has a sibling";
    }
    if (!grid.tree.isLeaf(n)) continue;
    ASSERT_EQ(node.firstObject, next);
    next += node.objectCount;
  }
  EXPECT_EQ(next, boxes.size());
}

TEST(LooseGrid, KeepsItsLaws) {
  for (const std::size_t count : {0U, 1U, 2U, 3000U}) {
    const std::vector<Aabb> boxes = gridBoxes(count, count);
    for (std::uint32_t cells = 2; cells <= kMostCellsPerAxis; ++cells)
      expectLaws(buildGrid(boxes, {.cellsPerAxis = cells}), boxes);
  }
  const std::vector<Aabb> onOneSpot(1000, Aabb{glm::vec3(4), glm::vec3(5)});
  expectLaws(buildGrid(onOneSpot), onOneSpot);
  const std::vector<Aabb> points(10, Aabb{glm::vec3(0), glm::vec3(0)});
  expectLaws(buildGrid(points), points);
  const std::vector<Aabb> many = gridBoxes(200'000, 9);
  expectLaws(buildGrid(many, {.voxelSize = 8.0F, .cellsPerAxis = 4}), many);
}

TEST(LooseGrid, ExtremeExtentsStayWithinItsVoxels) {
  constexpr float kMost = std::numeric_limits<float>::max();
  std::vector<Aabb> boxes = gridBoxes(50, 4);
  boxes.push_back({glm::vec3(-kMost), glm::vec3(kMost)});
  boxes.push_back({glm::vec3(kMost), glm::vec3(kMost)});
  expectLaws(buildGrid(boxes), boxes);
}

/// A few small objects, far apart: most levels of the tree part nothing and get no node.
TEST(LooseGrid, HasFewerThanTwoNodesAnObject) {
  std::vector<Aabb> boxes;
  for (const float place : {0.0F, 0.01F, 0.02F, 1000.0F})
    boxes.push_back({glm::vec3(place), glm::vec3(place + 0.001F)});
  for (std::uint32_t cells = 2; cells <= kMostCellsPerAxis; ++cells) {
    const LooseGrid grid = buildGrid(boxes, {.cellsPerAxis = cells});
    expectLaws(grid, boxes);
    EXPECT_LT(grid.tree.nodes.size(), 2 * boxes.size());
  }
}

/// Brute force: of two siblings that are cells, the boxes' lower corners differ by at least one cell on an axis.
TEST(LooseGrid, TheCellsOfANodeFollowEachOtherOnEachAxis) {
  const std::vector<Aabb> boxes = gridBoxes(2000, 12);
  for (std::uint32_t cells = 2; cells <= kMostCellsPerAxis; ++cells) {
    const LooseGrid grid = buildGrid(boxes, {.cellsPerAxis = cells});
    std::vector<std::vector<std::uint32_t>> children(grid.tree.nodes.size());
    for (std::uint32_t n = 1; n < grid.tree.nodes.size(); ++n)
      if (!grid.place[n].ownObjects) children[grid.tree.nodes[n].parent].push_back(n);
    for (const std::vector<std::uint32_t>& siblings : children) {
      for (const std::uint32_t a : siblings) {
        for (const std::uint32_t b : siblings) {
          for (int axis = 0; axis < 3; ++axis) {
            if (grid.place[a].cell[axis] >= grid.place[b].cell[axis]) continue;
            EXPECT_LT(grid.tree.nodes[a].boundsWorld.min[axis], grid.tree.nodes[b].boundsWorld.min[axis]);
          }
        }
      }
    }
  }
}

/// Bit a: the upper half of axis a.
GridPlace octant(unsigned bits) {
  return {.cell = {bits & 1U, bits >> 1U & 1U, bits >> 2U & 1U}, .ownObjects = false};
}

TEST(EyeSiding, CountsTheAxesOnTheEyesSide) {
  const glm::vec3 middle(0);
  EXPECT_EQ(eyeSiding(octant(7), middle, {1, 1, 1}), 3U);
  EXPECT_EQ(eyeSiding(octant(6), middle, {1, 1, 1}), 2U);
  EXPECT_EQ(eyeSiding(octant(0), middle, {1, 1, 1}), 0U);
  std::array<int, 4> counts{};
  for (unsigned bits = 0; bits < 8; ++bits)
    ++counts[eyeSiding(octant(bits), middle, {-1, 2, 0.5F})];
  EXPECT_EQ(counts, (std::array<int, 4>{1, 3, 3, 1}));
}

/// A ray that passes octant A and then octant B: A has more axes on the eye's side.
TEST(EyeSiding, EqualOctantsNeverHideEachOther) {
  Random random(3);
  const auto point = [&] { return glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
  int crossings = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const glm::vec3 eye = 3.0F * point();
    const glm::vec3 through = point();
    std::vector<unsigned> met;
    for (int step = 0; step < 200; ++step) {
      const glm::vec3 p = eye + (through - eye) * (static_cast<float>(step) * 0.01F);
      const unsigned bits = (p.x >= 0 ? 1U : 0U) | (p.y >= 0 ? 2U : 0U) | (p.z >= 0 ? 4U : 0U);
      if (met.empty() || met.back() != bits) met.push_back(bits);
    }
    for (std::size_t i = 1; i < met.size(); ++i, ++crossings)
      ASSERT_LT(eyeSiding(octant(met[i]), glm::vec3(0), eye), eyeSiding(octant(met[i - 1]), glm::vec3(0), eye));
  }
  EXPECT_GT(crossings, 10'000);
}

}  // namespace
}  // namespace jalousie::culling
