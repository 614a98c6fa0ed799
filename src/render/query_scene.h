// What the modes with occlusion queries or shadows share: the scene in the order of a spatial hierarchy.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "culling/loose_grid.h"
#include "render/methods/method_inputs.h"
#include "render/query_pass.h"
#include "render/slice_pass.h"

namespace jalousie::render {

/// Made empty; allocate() does the work when a mode is used for the first time.
class QueryScene {
 public:
  /// Builds the programs. @param grid  over a loose grid; absent: over a bounding volume hierarchy   Errors: kShader.
  explicit QueryScene(const MethodInputs& inputs, std::optional<culling::GridOptions> grid = {});

  /// Builds the hierarchy and all buffers. Nothing after the first time. Errors: kLimit.
  void allocate();
  /// Follows objects that were moved on the GPU: reads their transforms and boxes back.
  void follow(SceneBuffers& buffers);

  const culling::SpatialHierarchy& tree() const;
  const culling::LooseGrid* grid() const { return grid_ ? &*grid_ : nullptr; }
  const SliceOrder& order() const { return order_; }
  std::span<const Aabb> boundsWorld() const { return boundsWorld_; }          ///< by object
  std::span<const gpu::Transform> transforms() const { return transforms_; }  ///< by gpu::Object::transform
  /// SceneBuffers::movement of bounds and transforms.
  std::uint64_t movement() const { return movement_; }
  /// Grows whenever node numbers come to mean other nodes.
  std::uint64_t version() const { return version_; }
  SlicePass& slices() { return slices_; }
  QueryPass& queries() { return queries_; }

 private:
  void readBounds(SceneBuffers& buffers);
  void setTree();

  const scene::SceneData& scene_;
  std::optional<culling::GridOptions> gridOptions_;
  MemoryLimit memory_;
  const MemoryEstimate& needs_;
  SlicePass slices_;
  QueryPass queries_;
  bool allocated_ = false;
  std::vector<Aabb> boundsWorld_;           ///< by object
  std::vector<gpu::Transform> transforms_;  ///< read back once something has moved
  std::vector<gpu::Chain> chains_;          ///< read back
  std::optional<culling::MovingHierarchy> boxes_;
  std::optional<culling::LooseGrid> grid_;
  SliceOrder order_;
  std::uint64_t version_ = 0;
  std::uint64_t movement_ = 0;  ///< SceneBuffers::movement of the bounds
};

}  // namespace jalousie::render
