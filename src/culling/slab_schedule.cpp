// The recursion is as deep as the grids are nested.
#include "culling/slab_schedule.h"

#include <algorithm>
#include <cmath>

namespace jalousie::culling {
namespace {

constexpr std::size_t kMostGrids = 16;

}  // namespace

void SlabSchedule::decide() {
  levels_.resize(kMostGrids);
  const glm::vec3& forward = view_->forwardWorld;
  axis_ = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(forward[a]) > std::abs(forward[axis_])) axis_ = a;
  upwards_ = forward[axis_] >= 0.0F;
  if (!inView(0)) return;
  if (tree_.isLeaf(0)) {
    if (reachesNear(0) || passed(ask(0))) drawLeaf(0);
    return;
  }
  visit(0, 0);
}

void SlabSchedule::visit(std::uint32_t node, std::size_t depth) {
  Level& level = levels_[depth];
  collect(node, level.children);
  const std::size_t most = std::min(options_.batch, device_->capacity());
  std::size_t first = 0;
  while (first < level.children.size()) {
    std::size_t end = first + 1;
    while (end < level.children.size() && end - first < most && level.children[end].slab == level.children[first].slab)
      ++end;
    askBatch(first, end, level);
    for (const std::uint32_t visible : level.visible) {
      if (tree_.isLeaf(visible))
        drawLeaf(visible);
      else
        visit(visible, depth + 1);
    }
    first = end;
  }
}

void SlabSchedule::collect(std::uint32_t node, std::vector<Child>& children) {
  children.clear();
  for (std::uint32_t child = node + 1; child < tree_.nodes[node].skip; child = tree_.nodes[child].skip) {
    if (!inView(child)) continue;
    const GridPlace& place = grid_.place[child];
    const int along = place.cell[axis_];
    const int slab = upwards_ ? along : static_cast<int>(kMostCellsPerAxis) - along;
    children.push_back({place.ownObjects ? -1 : slab, placeOf(child)});
  }
  std::sort(children.begin(), children.end());
}

void SlabSchedule::askBatch(std::size_t first, std::size_t end, Level& level) {
  level.visible.clear();
  asked_.clear();
  for (std::size_t i = first; i < end; ++i) {
    const std::uint32_t node = level.children[i].place.node;
    if (reachesNear(node))
      level.visible.push_back(node);
    else
      asked_.push_back(ask(node));
  }
  const std::vector<std::uint32_t>& found = passedOf(asked_);
  level.visible.insert(level.visible.end(), found.begin(), found.end());
}

}  // namespace jalousie::culling
