// A tree over the boxes of objects, as flat arrays.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/aabb.h"

namespace jalousie::culling {

/// HierarchyNode::parent of the root.
inline constexpr std::uint32_t kNoParent = std::numeric_limits<std::uint32_t>::max();

/// One node. Nodes stand in depth-first order: the left child of an inner node n is n + 1, its right child is
/// nodes[n + 1].skip.
struct HierarchyNode {
  Aabb boundsWorld;               ///< of all objects below the node
  std::uint32_t parent = 0;       ///< index of the parent, kNoParent for the root
  std::uint32_t skip = 0;         ///< index of the first node that is not below this one; nodes.size() behind the last
  std::uint32_t firstObject = 0;  ///< of the node's range in SpatialHierarchy::objects
  std::uint32_t objectCount = 0;  ///< length of the range, at least 1; inner nodes hold the ranges of their children
};
static_assert(sizeof(HierarchyNode) == 40);

/// A binary tree in flat arrays, with every object in exactly one leaf.
struct SpatialHierarchy {
  std::vector<HierarchyNode> nodes;    ///< depth first, the root first; empty for a scene without objects
  std::vector<std::uint32_t> objects;  ///< indices of SceneData::objects, leaf after leaf; ascending inside a leaf
  std::vector<Aabb> objectBounds;      ///< [objects.size()] world boxes, in the order of `objects`

  bool isLeaf(std::uint32_t node) const { return nodes[node].skip == node + 1; }
};

}  // namespace jalousie::culling
