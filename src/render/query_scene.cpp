// Bounds come from the arrays of the scene, and from the GPU once something has moved.
#include "render/query_scene.h"

#include <algorithm>
#include <cmath>

#include "core/memory_estimate.h"
#include "scene/scene_memory.h"

namespace jalousie::render {
namespace {

/// Objects of a leaf: one query decides about so many.
constexpr std::uint32_t kLeafObjects = 4;

/// Most nodes of a hierarchy: leaves have an object at least.
std::uint32_t mostNodes(const scene::SceneData& scene) {
  return static_cast<std::uint32_t>(2 * scene.objects.size() + 1);
}

MemoryEstimate needsOf(const scene::SceneData& scene) {
  const std::uint64_t lists = scene.maxPatchTriangles > 0 ? gpu::kListCount : gpu::kListsPerDetail;
  const auto units = static_cast<std::uint32_t>(scene.drawn().objects.size());
  MemoryEstimate needs;
  needs.add(units, 2 * (lists * sizeof(gpu::DrawCommand) + sizeof(gpu::uint)) + 2 * sizeof(gpu::uint),
            scene::counted(units, "slices"));
  if (const std::uint32_t ranges = sliceRanges(scene.faces.mostGroups, units); ranges > 0)
    needs.add(units, 4 * (ranges + 1) * sizeof(gpu::DrawCommand), "commands of slices without back faces");
  constexpr std::uint64_t kNode = sizeof(culling::HierarchyNode) + 2 * sizeof(Aabb) + 64;  // with its history
  needs.add(scene.objects.size(), 2 * kNode + 2 * sizeof(Aabb) + 8 * sizeof(gpu::uint),
            scene::counted(scene.objects.size(), "objects of the hierarchy"));
  return needs;
}

}  // namespace

QueryScene::QueryScene(const MethodInputs& inputs, std::optional<culling::GridOptions> grid)
    : scene_(inputs.scene),
      gridOptions_(grid),
      memory_(inputs.memory),
      needs_(inputs.needs),
      slices_(inputs.shaders),
      queries_(inputs.shaders) {}

void QueryScene::allocate() {
  if (allocated_) return;
  MemoryEstimate needs = needs_;
  needs.add(needsOf(scene_));
  needs.require(memory_);
  boundsWorld_ = culling::worldBounds(scene_.objects, scene_.chains, scene_.transforms);
  slices_.allocate(scene_, mostNodes(scene_));
  queries_.allocate(mostNodes(scene_));
  if (gridOptions_)
    grid_ = culling::buildGrid(boundsWorld_, *gridOptions_);
  else
    boxes_.emplace(boundsWorld_, culling::HierarchyOptions{kLeafObjects});
  transforms_ = scene_.transforms;
  chains_.resize(scene_.chains.size());
  setTree();
  allocated_ = true;
}

const culling::SpatialHierarchy& QueryScene::tree() const {
  return boxes_ ? boxes_->tree() : grid_->tree;
}

void QueryScene::setTree() {
  order_.follow(scene_, tree());
  slices_.setOrder(order_);
  queries_.setBoxes(tree());
  ++version_;
}

void QueryScene::readBounds(SceneBuffers& buffers) {
  std::as_const(buffers).transforms().readInto(std::span(transforms_));
  buffers.chains().readInto(std::span(chains_));
  culling::worldBoundsInto(boundsWorld_, scene_.objects, chains_, transforms_);
}

void QueryScene::follow(SceneBuffers& buffers) {
  const std::uint64_t movement = buffers.movement();
  if (movement == movement_ || boundsWorld_.empty()) return;
  movement_ = movement;
  readBounds(buffers);
  if (grid_) {
    culling::rebuildGrid(*grid_, boundsWorld_, *gridOptions_);
    setTree();
  } else if (boxes_->follow(boundsWorld_)) {
    setTree();
  } else {
    queries_.setBoxes(tree());
  }
}

}  // namespace jalousie::render
