// What every builder of a hierarchy does: nodes in depth-first order over a permutation of the objects.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/check.h"
#include "culling/spatial_hierarchy.h"

namespace jalousie::culling {

/// Refuses boxes that no hierarchy holds. @pre min <= max, no NaN, fewer boxes than half of kNoParent (checked)
void requireBoxes(std::span<const Aabb> boundsWorld);

/// Makes a tree that has no nodes, over all objects in their order. Keeps its memory, and reserves what is missing.
void beginHierarchy(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld);

/// A stack that allocates nothing. @pre at most kCapacity entries (checked)
template <class T, std::size_t kCapacity>
class FixedStack {
 public:
  bool empty() const { return size_ == 0; }
  void push(const T& entry) {
    JAL_CHECK(size_ < kCapacity);
    entries_[size_++] = entry;
  }
  /// @pre !empty()
  const T& pop() { return entries_[--size_]; }

 private:
  std::array<T, kCapacity> entries_{};
  std::size_t size_ = 0;
};

/// Appends the node of a range of `objects`, with its box. @return  its index
std::uint32_t appendNode(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld, std::uint32_t parent,
                         std::span<const std::uint32_t> range);

/// Fills in what follows from the parents and the permutation: HierarchyNode::skip and objectBounds.
void finishHierarchy(SpatialHierarchy& hierarchy, std::span<const Aabb> boundsWorld);

}  // namespace jalousie::culling
