// Depth-first construction with a stack of ranges, as in hierarchy.cpp.
#include "culling/loose_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "culling/hierarchy_build.h"

namespace jalousie::culling {
namespace {

constexpr std::int32_t kMostVoxels = 1024;  // on an axis

struct Cell {
  std::uint32_t first = 0;  ///< of the permutation
  std::uint32_t count = 0;
  std::uint32_t parent = kNoParent;
  std::uint8_t octant = kOwnObjects;
  bool leaf = false;  ///< holds the objects of its parent
  glm::ivec3 low{0};  ///< voxels, inclusive
  glm::ivec3 end{0};  ///< exclusive
};

glm::dvec3 extentOf(const Aabb& box) {
  return glm::dvec3(box.max) - glm::dvec3(box.min);
}

class GridBuilder {
 public:
  GridBuilder(std::span<const Aabb> boxes, float voxelSize) : boxes_(boxes) {
    Aabb all;
    double sum = 0.0;
    for (const Aabb& box : boxes) {
      all.add(box);
      const glm::dvec3 e = extentOf(box);
      sum += std::max({e.x, e.y, e.z});
    }
    if (boxes.empty()) return;
    origin_ = glm::dvec3(all.min);
    const glm::dvec3 extent = extentOf(all);
    const double widest = std::max({extent.x, extent.y, extent.z});
    side_ = std::max(double{voxelSize} * sum / static_cast<double>(boxes.size()), widest / kMostVoxels);
    if (!(side_ > 0.0)) side_ = 1.0;
    for (int a = 0; a < 3; ++a)
      voxels_[a] = std::clamp(static_cast<std::int32_t>(extent[a] / side_) + 1, 1, kMostVoxels);
  }

  LooseGrid build() {
    result_.voxelSide = static_cast<float>(side_);
    result_.tree = emptyHierarchy(boxes_);
    std::vector<Cell> stack;
    if (!boxes_.empty())
      stack.push_back({.count = static_cast<std::uint32_t>(boxes_.size()), .low = glm::ivec3(0), .end = voxels_});
    while (!stack.empty()) {
      const Cell cell = stack.back();
      stack.pop_back();
      const std::uint32_t node = addNode(cell);
      if (!cell.leaf && cell.count > 1) split(cell, node, stack);
    }
    finishHierarchy(result_.tree, boxes_);
    return std::move(result_);
  }

 private:
  std::uint32_t addNode(const Cell& cell) {
    result_.octant.push_back(cell.octant);
    result_.middleWorld.emplace_back(origin_ + side_ * glm::dvec3(middleOf(cell)));
    const std::span<const std::uint32_t> objects = result_.tree.objects;
    return appendNode(result_.tree, boxes_, cell.parent, objects.subspan(cell.first, cell.count));
  }

  static glm::ivec3 middleOf(const Cell& cell) { return (cell.low + cell.end + 1) / 2; }

  glm::ivec3 voxelOf(const Aabb& box) const {
    const glm::dvec3 place = glm::floor((glm::dvec3(box.min) - origin_) / side_);
    return glm::ivec3(glm::clamp(place, glm::dvec3(0.0), glm::dvec3(voxels_ - 1)));
  }

  /// Octant of an object; kOwnObjects if it is larger than the octants on an axis that is halved.
  std::uint8_t octantOf(const Cell& cell, std::uint32_t object) const {
    const glm::ivec3 middle = middleOf(cell);
    const glm::ivec3 voxel = voxelOf(boxes_[object]);
    const glm::dvec3 extent = extentOf(boxes_[object]);
    unsigned octant = 0;
    for (int a = 0; a < 3; ++a) {
      if (cell.end[a] - cell.low[a] <= 1) continue;
      if (extent[a] > side_ * (cell.end[a] - middle[a])) return kOwnObjects;
      if (voxel[a] >= middle[a]) octant |= 1U << static_cast<unsigned>(a);
    }
    return static_cast<std::uint8_t>(octant);
  }

  void split(const Cell& cell, std::uint32_t node, std::vector<Cell>& stack) {
    if (glm::all(glm::lessThanEqual(cell.end - cell.low, glm::ivec3(1)))) return;  // a voxel
    const auto begin = result_.tree.objects.begin() + cell.first;
    // The objects of the node itself come first: they are large, and hide most.
    const auto rank = [&](std::uint32_t object) { return (octantOf(cell, object) + 1) % (kOwnObjects + 1); };
    std::stable_sort(begin, begin + cell.count, [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    std::array<Cell, kOwnObjects + 1> children;
    std::uint32_t next = cell.first;
    std::size_t used = 0;
    while (next < cell.first + cell.count) {
      Cell& child = children[used++];
      child = childOf(cell, node, octantOf(cell, result_.tree.objects[next]));
      child.first = next;
      while (next < cell.first + cell.count && octantOf(cell, result_.tree.objects[next]) == child.octant)
        ++next;
      child.count = next - child.first;
    }
    for (std::size_t i = used; i-- > 0;)  // the first child on top: it is the next node
      stack.push_back(children[i]);
  }

  static Cell childOf(const Cell& cell, std::uint32_t node, std::uint8_t octant) {
    Cell child{.parent = node, .octant = octant, .leaf = octant == kOwnObjects, .low = cell.low, .end = cell.end};
    const glm::ivec3 middle = middleOf(cell);
    for (int a = 0; a < 3 && !child.leaf; ++a) {
      if (cell.end[a] - cell.low[a] <= 1) continue;
      ((octant >> static_cast<unsigned>(a) & 1U) != 0 ? child.low : child.end)[a] = middle[a];
    }
    return child;
  }

  std::span<const Aabb> boxes_;
  glm::dvec3 origin_{0.0};
  double side_ = 1.0;
  glm::ivec3 voxels_{1};
  LooseGrid result_;
};

}  // namespace

LooseGrid buildGrid(std::span<const Aabb> boundsWorld, float voxelSize) {
  JAL_CHECK(voxelSize > 0.0F);
  requireBoxes(boundsWorld);
  return GridBuilder(boundsWorld, voxelSize).build();
}

std::uint32_t eyeSiding(std::uint8_t octant, const glm::vec3& middleWorld, const glm::vec3& eyeWorld) {
  if (octant == kOwnObjects) return 3;
  std::uint32_t sides = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const bool upper = (octant >> static_cast<unsigned>(axis) & 1U) != 0;
    if (upper == (eyeWorld[axis] >= middleWorld[axis])) ++sides;
  }
  return sides;
}

}  // namespace jalousie::culling
