// Following moved objects, building anew and deciding a frame allocate nothing once memory has been seen to suffice.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <new>

#include "core/random.h"
#include "culling/hierarchy.h"
#include "culling/loose_grid.h"
#include "culling/occluder_culling.h"
#include "culling/portal_culling.h"
#include "culling/schedule_table.h"
#include "scene/camera.h"
#include "support/building.h"

namespace {

std::atomic<std::uint64_t> allocations = 0;

void* allocate(std::size_t bytes) {
  ++allocations;
  void* memory = std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// For this whole program.
void* operator new(std::size_t bytes) {
  return allocate(bytes);
}
void* operator new[](std::size_t bytes) {
  return allocate(bytes);
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(bytes == 0 ? 1 : bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace jalousie::culling {
namespace {

std::vector<Aabb> scattered(std::uint64_t seed) {
  Random random(seed);
  std::vector<Aabb> boxes;
  for (int i = 0; i < 500; ++i) {
    const glm::vec3 low(random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(-10, 10));
    boxes.push_back({low, low + glm::vec3(random.uniform(0.1F, 2.0F))});
  }
  return boxes;
}

/// Every third node is hidden.
class FixedAnswers : public QueryDevice {
 public:
  std::uint32_t capacity() const override { return 400; }

 private:
  Query startQuery(std::span<const std::uint32_t> nodes) override { return nodes[0]; }
  std::uint64_t takeAnswer(Query query) override { return query % 3; }
  void drawObjects(std::uint32_t, std::uint32_t) override {}
  void drawConditionally(std::span<const Conditional>) override {}
};

TEST(Allocation, TreesThatAreBuiltAnewUseTheirOwnMemory) {
  const std::vector<Aabb> other = scattered(2);
  MovingHierarchy hierarchy(scattered(1));
  LooseGrid grid = buildGrid(scattered(1));
  const std::uint64_t before = allocations;
  EXPECT_TRUE(hierarchy.follow(other)) << "built anew";
  rebuildGrid(grid, other);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(hierarchy.tree().objects, buildHierarchy(other).objects);
  EXPECT_EQ(grid.tree.objects, buildGrid(other).tree.objects);
}

/// From the second frame on, of a view that is kept: units of grids have grown to their size.
TEST(Allocation, FramesAllocateNothing) {
  const std::vector<Aabb> boxes = scattered(1);
  const glm::uvec2 viewport(40);
  const scene::Camera camera = scene::lookAt({18, 3, 4}, glm::vec3(0), {glm::vec3(-10), glm::vec3(10)});
  const QueryView view =
      makeQueryView(scene::clipFromWorld(camera, 1.0F), glm::vec4(camera.positionWorld(), camera.zNear),
                    glm::vec4(camera.forwardWorld(), 0.0F), scene::focalPixels(camera, viewport), viewport);
  for (const QueryMethod method :
       {QueryMethod::kWait, QueryMethod::kBatch, QueryMethod::kCoherentFlat, QueryMethod::kCoherent,
        QueryMethod::kCoherentPlus, QueryMethod::kSlabs, QueryMethod::kSiblings, QueryMethod::kDeferred}) {
    const LooseGrid grid = buildGrid(boxes, needsGrid(method) ? gridOptions(method) : GridOptions{});
    const SpatialHierarchy tree = needsGrid(method) ? grid.tree : buildHierarchy(boxes);
    FixedAnswers device;
    const std::unique_ptr<QuerySchedule> schedule = makeSchedule(method, tree, &grid);
    schedule->run(view, {}, device);
    std::uint64_t allocated = 0;
    for (int frame = 0; frame < 24; ++frame) {
      const std::uint64_t before = allocations;
      schedule->run(view, {}, device);
      allocated += allocations - before;
    }
    EXPECT_EQ(allocated, 0U) << "method " << static_cast<int>(method);
    EXPECT_GT(device.figures().queries, 20U);
  }
}

/// Occluders of boxes that move: followed, chosen, cast and tested.
TEST(Allocation, ShadowsAllocateNothing) {
  scene::SceneData scene;
  gpu::Chain& chain = scene.chains.emplace_back();
  chain.boundsMinObject = glm::vec4(-1.0F);
  chain.boundsMaxObject = glm::vec4(1.0F);
  scene.occluders.push_back({solidOf({glm::vec3(-1.0F), glm::vec3(1.0F)}), 0, true});
  Random random(4);
  for (std::uint32_t i = 0; i < 300; ++i) {
    const glm::vec3 place(random.uniform(-30, 30), random.uniform(-5, 5), random.uniform(-30, 30));
    scene.objects.push_back({0, i, i, i});
    scene.transforms.push_back(scene::makeTransform(glm::translate(glm::mat4(1.0F), place)));
  }
  const std::vector<Aabb> boxes = worldBounds(scene.objects, scene.chains, scene.transforms);
  const SpatialHierarchy tree = buildHierarchy(boxes);
  const glm::uvec2 viewport(640, 360);
  const scene::Camera camera = scene::lookAt({40, 0, 4}, glm::vec3(0), {glm::vec3(-30), glm::vec3(30)});
  const QueryView view =
      makeQueryView(scene::clipFromWorld(camera, 1.6F), glm::vec4(camera.positionWorld(), camera.zNear),
                    glm::vec4(camera.forwardWorld(), 0.0F), scene::focalPixels(camera, viewport), viewport);
  for (const OccluderUse use : {OccluderUse::kSolids, OccluderUse::kPolygons}) {
    OccluderTable table(scene, use);
    ActiveSet active(table.placed().size());
    OccluderCulling culling(tree.nodes.size(), tree.objects.size());
    QueryFigures figures;
    const std::uint64_t before = allocations;
    for (const Cap cap : {Cap::kExact, Cap::kPaper}) {
      for (const Rank rank : {Rank::kSolidAngle, Rank::kPaper}) {
        table.follow(scene.objects, scene.transforms);
        const OccluderOptions options{.active = kMostActive, .cap = cap, .rank = rank};
        const auto shadows = active.cast(view, options, {table, scene.objects, scene.transforms, boxes});
        EXPECT_GT(shadows.size(), 10U);
        culling.cull(tree, view, shadows, figures);
      }
    }
    EXPECT_EQ(allocations, before);
    EXPECT_GT(figures.planeTests, 1000U);
  }
}

TEST(Allocation, PortalsAllocateNothing) {
  const test::Building building(5, {.blocks = 6});
  Random random(5);
  std::vector<Aabb> boxes;
  std::vector<std::uint32_t> places;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const glm::vec3 middle(building.randomPlace(random));
    boxes.push_back({middle - 0.3F, middle + 0.3F});
    places.push_back(i);
  }
  PortalCulling culling(building.plan(), boxes.size());
  const glm::uvec2 viewport(640, 360);
  scene::Camera camera =
      scene::lookAt(glm::vec3(building.randomPlace(random, 0.3)), {9, 1, 9}, {glm::vec3(0), glm::vec3(20)});
  camera.zNear = 0.05F;
  const PortalView view =
      makePortalView(scene::clipFromWorld(camera, 1.6F), glm::vec4(camera.positionWorld(), camera.zNear),
                     glm::vec4(camera.forwardWorld(), 0.0F), scene::focalPixels(camera, viewport), viewport);
  QueryFigures figures;
  const std::uint64_t before = allocations;
  for (int frame = 0; frame < 3; ++frame) {
    culling.follow(boxes);
    EXPECT_FALSE(culling.cull(view, boxes, places, PortalReach::kAll, figures).empty());
    for (Aabb& box : boxes)
      box = {box.min + glm::vec3(0.2F, 0.0F, 0.1F), box.max + glm::vec3(0.2F, 0.0F, 0.1F)};
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(figures.portals, 10U);
}

}  // namespace
}  // namespace jalousie::culling
