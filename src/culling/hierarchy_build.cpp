// Parents stand before their children.
#include "culling/hierarchy_build.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <numeric>

#include "core/check.h"

namespace jalousie::culling {

void requireBoxes(std::span<const Aabb> boundsWorld) {
  JAL_CHECK(boundsWorld.size() < kNoParent / 2);  // a tree has fewer than two nodes per object
  for (const Aabb& box : boundsWorld)
    JAL_CHECK(glm::all(glm::lessThanEqual(box.min, box.max)));
}

void beginHierarchy(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld) {
  hierarchy.nodes.clear();
  hierarchy.nodes.reserve(2 * boundsWorld.size());
  hierarchy.objects.resize(boundsWorld.size());
  std::iota(hierarchy.objects.begin(), hierarchy.objects.end(), 0U);
}

std::uint32_t appendNode(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld, std::uint32_t parent,
                         std::span<const std::uint32_t> range) {
  HierarchyNode node;
  node.parent = parent;
  node.firstObject = static_cast<std::uint32_t>(range.data() - hierarchy.objects.data());
  node.objectCount = static_cast<std::uint32_t>(range.size());
  for (const std::uint32_t object : range)
    node.boundsWorld.add(boundsWorld[object]);
  hierarchy.nodes.push_back(node);
  return static_cast<std::uint32_t>(hierarchy.nodes.size() - 1);
}

/// A subtree ends where the next node's parent lies above it: going backwards, a leaf skips to its successor and an
/// inner node to where its last child skips to.
void finishHierarchy(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld) {
  std::vector<HierarchyNode>& nodes = hierarchy.nodes;
  for (std::uint32_t n = 0; n < nodes.size(); ++n)
    nodes[n].skip = n + 1;
  for (auto n = static_cast<std::uint32_t>(nodes.size()); n-- > 1;)
    nodes[nodes[n].parent].skip = std::max(nodes[nodes[n].parent].skip, nodes[n].skip);
  hierarchy.objectBounds.resize(boundsWorld.size());
  for (std::size_t i = 0; i < boundsWorld.size(); ++i)
    hierarchy.objectBounds[i] = boundsWorld[hierarchy.objects[i]];
}

}  // namespace jalousie::culling
