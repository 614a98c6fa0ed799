// What every builder of a hierarchy does: nodes in depth-first order over a permutation of the objects.
#pragma once

#include <cstdint>
#include <span>

#include "culling/spatial_hierarchy.h"

namespace jalousie::culling {

/// Refuses boxes that no hierarchy holds. @pre min <= max, no NaN, fewer boxes than half of kNoParent (checked)
void requireBoxes(std::span<const Aabb> boundsWorld);

/// A tree without nodes, over all objects in their order.
SpatialHierarchy emptyHierarchy(std::span<const Aabb> boundsWorld);

/// Appends the node of a range of `objects`, with its box. @return  its index
std::uint32_t appendNode(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld, std::uint32_t parent,
                         std::span<const std::uint32_t> range);

/// Fills in what follows from the parents and the permutation: HierarchyNode::skip and objectBounds.
void finishHierarchy(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld);

}  // namespace jalousie::culling
