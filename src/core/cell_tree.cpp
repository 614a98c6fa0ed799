// Built and assigned by partitions in place, without recursion: the tree may be as deep as there are triangles.
#include "core/cell_tree.h"

#include <algorithm>
#include <numeric>

#include "core/aabb.h"
#include "core/check.h"

namespace jalousie {
namespace {

/// A part of the triangles, as a range of their permutation, and the node that it belongs to.
struct Part {
  std::size_t first;
  std::size_t end;
  std::uint32_t parent;  ///< node whose second part this is; kNone for a first part or the root
};

constexpr std::uint32_t kNone = 0xffffffffU;

std::vector<std::uint32_t> numbered(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

int longestAxis(const glm::vec3& extent) {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (extent[k] > extent[axis]) axis = k;
  return axis;
}

}  // namespace

/// Makes the nodes of one tree.
class CellTree::Builder {
 public:
  Builder(std::span<const glm::vec3> centroids, CellTree& tree)
      : centroids_(centroids), order_(numbered(centroids.size())), tree_(tree) {}

  void run() {
    std::vector<Part> open{{0, order_.size(), kNone}};
    while (!open.empty()) {
      const Part part = open.back();
      open.pop_back();
      const auto node = static_cast<std::uint32_t>(tree_.nodes_.size());
      if (part.parent != kNone) tree_.nodes_[part.parent].second = node;
      Node made;
      made.firstCell = tree_.cellCount_;
      const std::size_t middle = split(part, made);
      tree_.nodes_.push_back(made);
      if (made.axis < 0) {
        ++tree_.cellCount_;
        continue;
      }
      open.push_back({middle, part.end, node});
      open.push_back({part.first, middle, kNone});
    }
  }

 private:
  /// Chooses the plane of a part and sorts its triangles by it. @return the first triangle at or beyond the plane
  std::size_t split(const Part& part, Node& node) {
    const std::size_t count = part.end - part.first;
    if (count <= tree_.trianglesPerCell_) return part.end;
    Aabb bounds;
    for (std::size_t i = part.first; i < part.end; ++i)
      bounds.add(centroids_[order_[i]]);
    const int axis = longestAxis(bounds.extent());
    if (!(bounds.max[axis] > bounds.min[axis])) return part.end;
    // Parts in proportion to whole cells, so that no cell stays half empty.
    const std::size_t cells = (count + tree_.trianglesPerCell_ - 1) / tree_.trianglesPerCell_;
    const auto begin = order_.begin();
    const auto at = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
    const auto along = [&](std::uint32_t triangle) { return centroids_[triangle][axis]; };
    const std::size_t target = part.first + count * (cells / 2) / cells;
    std::nth_element(at(part.first), at(target), at(part.end),
                     [&](std::uint32_t a, std::uint32_t b) { return along(a) < along(b); });
    node.axis = axis;
    node.plane = along(order_[target]);
    // Where the least value fills the whole first part, the plane is the next larger value.
    if (!(node.plane > bounds.min[axis])) node.plane = leastAbove(part, axis, bounds.min[axis], bounds.max[axis]);
    const auto middle =
        std::partition(at(part.first), at(part.end), [&](std::uint32_t t) { return along(t) < node.plane; });
    return static_cast<std::size_t>(middle - begin);
  }

  float leastAbove(const Part& part, int axis, float bound, float least) const {
    for (std::size_t i = part.first; i < part.end; ++i) {
      const float value = centroids_[order_[i]][axis];
      if (value > bound) least = std::min(least, value);
    }
    return least;
  }

  std::span<const glm::vec3> centroids_;
  std::vector<std::uint32_t> order_;
  CellTree& tree_;
};

CellTree::CellTree(std::span<const glm::vec3> centroids, std::uint32_t trianglesPerCell)
    : trianglesPerCell_(trianglesPerCell) {
  JAL_CHECK(trianglesPerCell > 0U);
  Builder(centroids, *this).run();
}

std::vector<std::uint32_t> CellTree::assign(std::span<const glm::vec3> centroids) const {
  struct Visit {
    std::uint32_t node;
    std::size_t first, end;
  };
  std::vector<std::uint32_t> order = numbered(centroids.size());
  std::vector<std::uint32_t> cells(centroids.size());
  std::vector<Visit> open{{0, 0, order.size()}};
  while (!open.empty()) {
    const Visit visit = open.back();
    open.pop_back();
    const Node& node = nodes_[visit.node];
    const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    if (node.axis < 0 || visit.end - visit.first <= trianglesPerCell_) {
      for (std::size_t i = visit.first; i < visit.end; ++i)
        cells[order[i]] = node.firstCell;
      continue;
    }
    const auto middle = std::partition(at(visit.first), at(visit.end), [&](std::uint32_t triangle) {
      return centroids[triangle][node.axis] < node.plane;
    });
    const auto split = static_cast<std::size_t>(middle - order.begin());
    open.push_back({visit.node + 1, visit.first, split});
    open.push_back({node.second, split, visit.end});
  }
  return cells;
}

glm::vec3 triangleCentroid(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return {(glm::dvec3(a) + glm::dvec3(b) + glm::dvec3(c)) / 3.0};
}

CellOrder orderByCell(std::span<const std::uint32_t> cells, std::uint32_t cellCount) {
  CellOrder order;
  order.triangles.resize(cells.size());
  std::vector<std::uint32_t> next(cellCount, 0);  // per cell the place of its next triangle
  for (const std::uint32_t cell : cells)
    ++next[cell];
  std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
  for (std::uint32_t triangle = 0; triangle < cells.size(); ++triangle)
    order.triangles[next[cells[triangle]]++] = triangle;
  order.ends = std::move(next);
  return order;
}

}  // namespace jalousie
