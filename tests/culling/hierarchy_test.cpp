// Laws of the spatial hierarchy, and its queries against brute force.
#include "culling/hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/random.h"
#include "scene/camera.h"
#include "support/scenes.h"

namespace jalousie::culling {
namespace {

bool holds(const Aabb& outer, const Aabb& inner) {
  return glm::all(glm::lessThanEqual(outer.min, inner.min)) && glm::all(glm::greaterThanEqual(outer.max, inner.max));
}

std::uint32_t depthOf(const SpatialHierarchy& tree) {
  std::vector<std::uint32_t> depths(tree.nodes.size(), 0);
  for (std::size_t n = 1; n < tree.nodes.size(); ++n)
    depths[n] = depths[tree.nodes[n].parent] + 1;  // a parent stands before its children
  return depths.empty() ? 0 : *std::max_element(depths.begin(), depths.end());
}

void expectInnerNode(const SpatialHierarchy& tree, std::uint32_t n) {
  const HierarchyNode& node = tree.nodes[n];
  const std::uint32_t right = tree.nodes[n + 1].skip;
  ASSERT_LT(right, tree.nodes.size());
  EXPECT_EQ(tree.nodes[right].skip, node.skip);
  std::uint32_t next = node.firstObject;
  for (const std::uint32_t child : {n + 1, right}) {
    EXPECT_EQ(tree.nodes[child].parent, n);
    EXPECT_EQ(tree.nodes[child].firstObject, next);
    EXPECT_GE(tree.nodes[child].objectCount, 1U);
    EXPECT_TRUE(holds(node.boundsWorld, tree.nodes[child].boundsWorld));
    next += tree.nodes[child].objectCount;
  }
  EXPECT_EQ(next, node.firstObject + node.objectCount);
}

/// Every law that a hierarchy over these boxes has to keep.
void expectLaws(const SpatialHierarchy& tree, const std::vector<Aabb>& boxes, std::uint32_t maxLeafObjects) {
  std::vector<std::uint32_t> sorted = tree.objects;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted.size(), boxes.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i)
    ASSERT_EQ(sorted[i], i) << "every object exactly once";
  ASSERT_EQ(tree.nodes.empty(), boxes.empty());
  if (boxes.empty()) return;
  EXPECT_EQ(tree.nodes[0].parent, kNoParent);
  EXPECT_EQ(tree.nodes[0].skip, tree.nodes.size());
  EXPECT_LT(tree.nodes.size(), 2 * boxes.size());
  EXPECT_LE(depthOf(tree), 64U);
  std::uint32_t next = 0;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (!tree.isLeaf(n)) {
      expectInnerNode(tree, n);
      continue;
    }
    const HierarchyNode& leaf = tree.nodes[n];
    ASSERT_EQ(leaf.firstObject, next) << "leaves hold the objects one after the other";
    ASSERT_LE(leaf.objectCount, maxLeafObjects);
    for (std::uint32_t i = next; i < next + leaf.objectCount; ++i) {
      ASSERT_TRUE(holds(leaf.boundsWorld, boxes[tree.objects[i]]));
      ASSERT_EQ(tree.objectBounds[i].min, boxes[tree.objects[i]].min);
      ASSERT_EQ(tree.objectBounds[i].max, boxes[tree.objects[i]].max);
      ASSERT_TRUE(i == next || tree.objects[i - 1] < tree.objects[i]);
    }
    next += leaf.objectCount;
  }
  EXPECT_EQ(next, boxes.size());
}

template <class T>
bool equalBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

std::vector<Aabb> randomBoxes(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 center(random.uniform(-50, 50), random.uniform(-5, 5), random.uniform(-50, 50));
    const glm::vec3 half = std::exp2(-random.uniform(0.0F, 10.0F)) * glm::vec3(random.uniform(), 1, random.uniform());
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

TEST(Hierarchy, KeepsItsLawsForAnyCountAndLeafSize) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 4U, 5U, 17U, 1000U}) {
    for (const std::uint32_t leaf : {1U, 4U, 64U}) {
      const std::vector<Aabb> boxes = randomBoxes(count, count + leaf);
      expectLaws(buildHierarchy(boxes, {leaf}), boxes, leaf);
    }
  }
}

TEST(Hierarchy, EveryRunGivesTheSameBytes) {
  const std::vector<Aabb> boxes = randomBoxes(5000, 8);
  const SpatialHierarchy first = buildHierarchy(boxes);
  const SpatialHierarchy second = buildHierarchy(boxes);
  EXPECT_TRUE(equalBytes(first.nodes, second.nodes));
  EXPECT_TRUE(equalBytes(first.objects, second.objects));
  EXPECT_TRUE(equalBytes(first.objectBounds, second.objectBounds));
}

TEST(Hierarchy, AMillionEqualBoxesGiveABalancedTree) {
  const std::vector<Aabb> boxes(1'000'000, Aabb{glm::vec3(1), glm::vec3(2)});
  const SpatialHierarchy tree = buildHierarchy(boxes);
  expectLaws(tree, boxes, 4);
  EXPECT_LE(depthOf(tree), 19U);
}

TEST(Hierarchy, DistancesThatDoubleDoNotMakeItDeep) {
  // The heuristic alone cuts off the outermost boxes at every level.
  std::vector<Aabb> boxes;
  for (int i = 0; i < 240; ++i) {
    const glm::vec3 center(std::ldexp(1.0F, i - 120), 0, 0);
    boxes.insert(boxes.end(), 40, {center, center});
  }
  expectLaws(buildHierarchy(boxes, {1}), boxes, 1);
}

TEST(Hierarchy, ExtremePointsAndFlatBoxesKeepTheLaws) {
  constexpr float kMost = std::numeric_limits<float>::max();
  constexpr float kLeast = std::numeric_limits<float>::denorm_min();
  std::vector<Aabb> boxes = {{glm::vec3(-kMost), glm::vec3(kMost)},  {glm::vec3(kMost), glm::vec3(kMost)},
                             {glm::vec3(-kMost), glm::vec3(-kMost)}, {glm::vec3(0), glm::vec3(0)},
                             {glm::vec3(kLeast), glm::vec3(kLeast)}, {glm::vec3(-kLeast), glm::vec3(kLeast)},
                             {{0, -kMost, 0}, {0, kMost, 0}},        {{-1, 0, -1}, {1, 0, 1}}};
  for (int copies = 0; copies < 3; ++copies)
    boxes.insert(boxes.end(), boxes.begin(), boxes.begin() + 8);
  expectLaws(buildHierarchy(boxes, {1}), boxes, 1);
}

/// Six planes of a clip volume with reversed depth, inside where dot(plane, point) >= 0.
std::vector<glm::vec4> planesOf(const glm::mat4& clipFromWorld) {
  const glm::mat4 rows = glm::transpose(clipFromWorld);
  return {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[2], rows[3] - rows[2]};
}

/// Whether no plane has the whole box on its outer side. In double precision: a part of a box never passes alone.
bool mayBeInside(const std::vector<glm::vec4>& planes, const Aabb& box) {
  return std::all_of(planes.begin(), planes.end(), [&](const glm::vec4& plane) {
    double farthest = plane.w;
    for (int axis = 0; axis < 3; ++axis)
      farthest += std::max(double{plane[axis]} * double{box.min[axis]}, double{plane[axis]} * double{box.max[axis]});
    return farthest >= 0.0;
  });
}

TEST(Hierarchy, QueriesGiveWhatBruteForceGives) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(3000, 20.0F, 5));
  const SpatialHierarchy tree = buildHierarchy(scene);
  std::size_t visited = 0;
  std::size_t tests = 0;
  for (const glm::vec3 eye : {glm::vec3(0, 0, 60), glm::vec3(3, 2, 1), glm::vec3(-25, 9, 0)}) {
    scene::Camera camera = scene::lookAt(eye, {1, 0.5F, 0}, scene.boundsWorld);
    camera.fovY = 0.2F;
    const std::vector<glm::vec4> planes = planesOf(scene::clipFromWorld(camera, 1.5F));
    std::vector<std::uint32_t> found;
    visitObjects(
        tree,
        [&](const Aabb& box) {
          ++tests;
          return mayBeInside(planes, box);
        },
        [&](std::uint32_t object) { found.push_back(object); });
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> expected;
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object)
      if (mayBeInside(planes, worldBounds(scene, object))) expected.push_back(object);
    EXPECT_EQ(found, expected);
    visited += found.size();
  }
  EXPECT_GT(visited, 100U);
  EXPECT_LT(visited, scene.objects.size());
  // Brute force takes one test per object and camera.
  EXPECT_LT(tests, 2 * scene.objects.size()) << "nodes that fail are skipped with everything below them";
}

TEST(Hierarchy, ObjectsThatShareATransformAndOverflowsHaveBoxes) {
  asset::SceneFile file = test::sphereChain(1);
  test::addInstance(file, 0, {5, 0, 0}, glm::vec3(1));
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  scene::SceneData scene = scene::buildScene(file);
  scene.objects[1].transform = 0;
  EXPECT_EQ(worldBounds(scene, 1).center(), worldBounds(scene, 0).center());
  scene.chains[0].boundsMaxObject = glm::vec4(3e38F);
  scene.transforms[0] = scene::makeTransform(glm::mat4(glm::mat3(9.0F)));
  const SpatialHierarchy tree = buildHierarchy(scene, {1});
  expectLaws(tree, {worldBounds(scene, 0), worldBounds(scene, 1)}, 1);
  EXPECT_EQ(worldBounds(scene, 0).min.x, std::numeric_limits<float>::lowest());
}

/// Boxes a step further along paths of their own.
std::vector<Aabb> moved(std::vector<Aabb> boxes, float distance, std::uint64_t seed) {
  Random random(seed);
  for (Aabb& box : boxes) {
    const glm::vec3 step(random.uniform(-distance, distance), random.uniform(-distance, distance), 0);
    box = {box.min + step, box.max + step};
  }
  return boxes;
}

TEST(Hierarchy, FitsObjectsThatMove) {
  for (const std::size_t count : {0U, 1U, 2U, 900U}) {
    const std::vector<Aabb> boxes = randomBoxes(count, 3);
    SpatialHierarchy tree = buildHierarchy(boxes);
    const std::vector<Aabb> later = moved(boxes, 30.0F, 9);
    refit(tree, later);
    expectLaws(tree, later, 4);
  }
}

TEST(Hierarchy, IsBuiltAnewOnlyWhereItsCostHasGrownByHalf) {
  const std::vector<Aabb> boxes = randomBoxes(3000, 4);
  MovingHierarchy hierarchy(boxes);
  EXPECT_FALSE(hierarchy.follow(moved(boxes, 0.05F, 1)));
  const double cost = costOf(hierarchy.tree());
  const std::vector<Aabb> far = moved(boxes, 60.0F, 2);
  EXPECT_TRUE(hierarchy.follow(far));
  expectLaws(hierarchy.tree(), far, 4);
  EXPECT_EQ(costOf(hierarchy.tree()), costOf(buildHierarchy(far)));
  EXPECT_GT(cost, 1.0);
  EXPECT_EQ(costOf(buildHierarchy(std::vector<Aabb>{})), 0.0);
  EXPECT_FALSE(MovingHierarchy(std::vector<Aabb>(50, Aabb{glm::vec3(1), glm::vec3(1)}))
                   .follow(std::vector<Aabb>(50, Aabb{glm::vec3(2), glm::vec3(2)})))
      << "all objects at one point";
}

TEST(Hierarchy, TwoHundredThousandMovingObjectsKeepTheLaws) {
  const std::vector<Aabb> boxes = randomBoxes(200'000, 5);
  MovingHierarchy hierarchy(boxes);
  const std::vector<Aabb> later = moved(boxes, 2.0F, 6);
  hierarchy.follow(later);
  expectLaws(hierarchy.tree(), later, 4);
}

}  // namespace
}  // namespace jalousie::culling
