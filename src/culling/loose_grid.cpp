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
constexpr std::size_t kMostHalvings = 10;   // halvings of them
constexpr std::size_t kMostChildren = kMostCellsPerAxis * kMostCellsPerAxis * kMostCellsPerAxis + 1;

struct Cell {
  std::uint32_t first = 0;  ///< of the permutation
  std::uint32_t count = 0;
  std::uint32_t parent = kNoParent;
  GridPlace place;
  glm::ivec3 low{0};  ///< voxels, inclusive
  glm::ivec3 end{0};  ///< exclusive
};

glm::dvec3 extentOf(const Aabb& box) {
  return glm::dvec3(box.max) - glm::dvec3(box.min);
}

class GridBuilder {
 public:
  GridBuilder(LooseGrid& result, std::span<const Aabb> boxes, const GridOptions& options)
      : result_(result), boxes_(boxes), cells_(static_cast<std::int32_t>(options.cellsPerAxis)) {
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
    side_ = std::max(double{options.voxelSize} * sum / static_cast<double>(boxes.size()), widest / kMostVoxels);
    if (!(side_ > 0.0)) side_ = 1.0;
    for (int a = 0; a < 3; ++a)
      voxels_[a] = std::clamp(static_cast<std::int32_t>(extent[a] / side_) + 1, 1, kMostVoxels);
  }

  void build() {
    result_.voxelSide = static_cast<float>(side_);
    beginHierarchy(result_.tree, boxes_);
    result_.place.clear();
    result_.middleWorld.clear();
    FixedStack<Cell, kMostHalvings * kMostChildren> stack;
    if (!boxes_.empty())
      stack.push(
          {.count = static_cast<std::uint32_t>(boxes_.size()), .place = {}, .low = glm::ivec3(0), .end = voxels_});
    while (!stack.empty()) {
      Cell cell = stack.pop();
      const bool parted = cell.count > 1 && narrow(cell);
      const std::uint32_t node = addNode(cell);
      if (parted) split(cell, node, stack);
    }
    finishHierarchy(result_.tree, boxes_);
  }

 private:
  std::uint32_t addNode(const Cell& cell) {
    result_.place.push_back(cell.place);
    result_.middleWorld.emplace_back(origin_ + side_ * glm::dvec3(cell.low + cellWidth(cell)));
    return appendNode(result_.tree, boxes_, cell.parent, objectsOf(cell));
  }

  std::span<std::uint32_t> objectsOf(const Cell& cell) {
    return std::span(result_.tree.objects).subspan(cell.first, cell.count);
  }

  /// Voxels of a child on each axis; the last child may have fewer.
  glm::ivec3 cellWidth(const Cell& cell) const { return (cell.end - cell.low + cells_ - 1) / cells_; }

  glm::ivec3 voxelOf(const Aabb& box) const {
    const glm::dvec3 place = glm::floor((glm::dvec3(box.min) - origin_) / side_);
    return glm::ivec3(glm::clamp(place, glm::dvec3(0.0), glm::dvec3(voxels_ - 1)));
  }

  /// Place of an object; no cell if it is larger than the smallest child on an axis that is divided.
  GridPlace placeOf(const Cell& cell, std::uint32_t object) const {
    const glm::ivec3 width = cellWidth(cell);
    const glm::ivec3 voxel = voxelOf(boxes_[object]);
    const glm::dvec3 extent = extentOf(boxes_[object]);
    GridPlace place{.ownObjects = false};
    for (int a = 0; a < 3; ++a) {
      const std::int32_t voxels = cell.end[a] - cell.low[a];
      if (voxels <= 1) continue;
      const std::int32_t last = (voxels - 1) % width[a] + 1;
      if (extent[a] > side_ * last) return {};
      place.cell[a] = static_cast<std::uint8_t>((voxel[a] - cell.low[a]) / width[a]);
    }
    return place;
  }

  /// The objects of the node itself come first: they are large, and hide most.
  std::uint32_t rankOf(const Cell& cell, std::uint32_t object) const {
    const GridPlace place = placeOf(cell, object);
    if (place.ownObjects) return 0;
    const auto cells = static_cast<std::uint32_t>(cells_);
    return 1 + (place.cell.z * cells + place.cell.y) * cells + place.cell.x;
  }

  /// Makes a cell smaller until its objects lie in different children. @return  whether they do: not in a voxel, nor
  /// if all are too large for the children
  bool narrow(Cell& cell) {
    while (!glm::all(glm::lessThanEqual(cell.end - cell.low, glm::ivec3(1)))) {
      const std::span<const std::uint32_t> objects = objectsOf(cell);
      const std::uint32_t rank = rankOf(cell, objects[0]);
      for (const std::uint32_t object : objects)
        if (rankOf(cell, object) != rank) return true;
      if (rank == 0) return false;
      shrinkTo(placeOf(cell, objects[0]), cell);
    }
    return false;
  }

  void shrinkTo(const GridPlace& place, Cell& cell) const {
    const glm::ivec3 width = cellWidth(cell);
    const glm::ivec3 low = cell.low + glm::ivec3(place.cell) * width;
    cell.end = glm::min(low + width, cell.end);
    cell.low = low;
  }

  void split(const Cell& cell, std::uint32_t node, FixedStack<Cell, kMostHalvings * kMostChildren>& stack) {
    const std::span<std::uint32_t> objects = objectsOf(cell);
    std::sort(objects.begin(), objects.end(), [&](std::uint32_t a, std::uint32_t b) {
      const std::uint32_t rankA = rankOf(cell, a);
      const std::uint32_t rankB = rankOf(cell, b);
      return rankA != rankB ? rankA < rankB : a < b;
    });
    // From the last child to the first, which then lies on top: it is the next node.
    std::uint32_t end = cell.count;
    while (end > 0) {
      const std::uint32_t rank = rankOf(cell, objects[end - 1]);
      std::uint32_t first = end;
      while (first > 0 && rankOf(cell, objects[first - 1]) == rank)
        --first;
      Cell child = cell;
      child.first = cell.first + first;
      child.count = end - first;
      child.parent = node;
      child.place = placeOf(cell, objects[first]);
      // Those of the node itself become a leaf: a box of one voxel is not divided.
      if (child.place.ownObjects) child.end = child.low + 1;
      if (!child.place.ownObjects) shrinkTo(child.place, child);
      stack.push(child);
      end = first;
    }
  }

  LooseGrid& result_;
  std::span<const Aabb> boxes_;
  std::int32_t cells_;
  glm::dvec3 origin_{0.0};
  double side_ = 1.0;
  glm::ivec3 voxels_{1};
};

}  // namespace

LooseGrid buildGrid(std::span<const Aabb> boundsWorld, const GridOptions& options) {
  LooseGrid grid;
  rebuildGrid(grid, boundsWorld, options);
  return grid;
}

void rebuildGrid(LooseGrid& grid, std::span<const Aabb> boundsWorld, const GridOptions& options) {
  JAL_CHECK(options.voxelSize > 0.0F);
  JAL_CHECK(options.cellsPerAxis >= 2U);
  JAL_CHECK(options.cellsPerAxis <= kMostCellsPerAxis);
  requireBoxes(boundsWorld);
  grid.place.reserve(2 * boundsWorld.size());
  grid.middleWorld.reserve(2 * boundsWorld.size());
  GridBuilder(grid, boundsWorld, options).build();
}

std::uint32_t eyeSiding(const GridPlace& place, const glm::vec3& middleWorld, const glm::vec3& eyeWorld) {
  if (place.ownObjects) return 3;
  std::uint32_t sides = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const bool upper = place.cell[axis] > 0;
    if (upper == (eyeWorld[axis] >= middleWorld[axis])) ++sides;
  }
  return sides;
}

}  // namespace jalousie::culling
