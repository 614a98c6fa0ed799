// A bounding volume hierarchy over the objects of a scene. For methods whose traversal runs on the CPU: a verdict
// before the frame, or queries issued while a traversal goes on. Methods that decide on the GPU do not need it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "culling/spatial_hierarchy.h"
#include "scene/scene_data.h"

namespace jalousie::culling {

struct HierarchyOptions {
  std::uint32_t maxLeafObjects = 4;  ///< most objects of one leaf, at least 1 (checked)
};

/// Builds a hierarchy top down. A range of objects is cut where the surface area heuristic is smallest (Wald 2007, "On
/// fast construction of SAH-based bounding volume hierarchies", binned over the centers of the boxes), and in two
/// halves where all centers are equal or the tree is already 32 levels deep. The depth is therefore at most 64, for any
/// input. Equal input gives equal bytes.
/// @param boundsWorld  [object count], min <= max, no NaN (checked)   O(n log n); throws only std::bad_alloc
SpatialHierarchy buildHierarchy(std::span<const Aabb> boundsWorld, const HierarchyOptions& options = {});
/// As above, over the world boxes of the scene's objects (worldBounds).
SpatialHierarchy buildHierarchy(const scene::SceneData& scene, const HierarchyOptions& options = {});

/// Expected cost of finding what a ray or a small query meets: surface areas of the inner nodes plus those of the
/// leaves times their objects, over the area of the root; 0 for an empty hierarchy. The measure that buildHierarchy
/// keeps small, and that grows as objects move away from where they were when it was built.
double costOf(const SpatialHierarchy& hierarchy);

/// In double precision: areas of any boxes of floats are finite.
double surfaceArea(const Aabb& box);

/// Fits all boxes to objects that moved; the tree stays as it is. O(nodes), allocates nothing.
/// @param boundsWorld  [objects.size()] by object, min <= max, no NaN (checked)
void refit(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld);

/// A hierarchy over objects that move: fitted anew, and built anew where its cost has grown by half since it was built.
class MovingHierarchy {
 public:
  /// As buildHierarchy.
  explicit MovingHierarchy(std::span<const Aabb> boundsWorld, const HierarchyOptions& options = {});

  const SpatialHierarchy& tree() const { return tree_; }
  /// Follows the objects. Allocates nothing. Returns whether the tree was built anew, so that node numbers mean other
  /// nodes now.
  bool follow(std::span<const Aabb> boundsWorld);

 private:
  HierarchyOptions options_;
  SpatialHierarchy tree_;
  std::vector<std::uint32_t> aside_;  ///< memory for building
  double builtCost_ = 0.0;
};

/// World box of one object: the box of its chain, transformed. A coordinate outside the range of float, which the
/// product of an extreme transform and an extreme box may have, widens the box to the whole range on its axis.
Aabb worldBounds(const gpu::Chain& chain, const gpu::Transform& transform);
Aabb worldBounds(const scene::SceneData& scene, std::uint32_t object);
/// Of all objects. @param chains, transforms  by the indices of the objects
std::vector<Aabb> worldBounds(std::span<const gpu::Object> objects, std::span<const gpu::Chain> chains,
                              std::span<const gpu::Transform> transforms);
/// The same into an array. @param boxes  [objects.size()] (checked)
void worldBoundsInto(std::span<Aabb> boxes, std::span<const gpu::Object> objects, std::span<const gpu::Chain> chains,
                     std::span<const gpu::Transform> transforms);

/// Calls visit(object index) for each object whose box passes the test, in the order of `objects`, and leaves out all
/// nodes whose box fails it. Needs no stack.
/// @param test  bool(const Aabb& boundsWorld); must hold for a box if it holds for a part of that box
template <class Test, class Visit>
void visitObjects(const SpatialHierarchy& hierarchy, const Test& test, const Visit& visit) {
  std::uint32_t n = 0;
  while (n < hierarchy.nodes.size()) {
    const HierarchyNode& node = hierarchy.nodes[n];
    if (!test(node.boundsWorld)) {
      n = node.skip;
      continue;
    }
    for (std::uint32_t i = 0; hierarchy.isLeaf(n) && i < node.objectCount; ++i)
      if (test(hierarchy.objectBounds[node.firstObject + i])) visit(hierarchy.objects[node.firstObject + i]);
    ++n;
  }
}

}  // namespace jalousie::culling
