// The recursion is as deep as the grid's tree: one level per halving of 1024 voxels, and one more.
#include "culling/sibling_schedule.h"

#include <algorithm>

namespace jalousie::culling {
namespace {

constexpr std::uint32_t kMostLevels = 16;

}  // namespace

void SiblingSchedule::decide() {
  levels_.resize(kMostLevels);
  visible_.resize(kMostLevels);
  levels_[0][0].assign(1, 0);
  visit(levels_[0][0], 0);
}

void SiblingSchedule::visit(const Unit& unit, std::uint32_t depth) {
  Unit& visible = visible_[depth];
  findVisible(unit, depth, visible);
  Level& next = levels_[depth + 1];
  for (Unit& below : next)
    below.clear();
  for (const std::uint32_t node : visible) {
    if (tree_.isLeaf(node)) drawLeaf(node);
    for (std::uint32_t child = node + 1; child < tree_.nodes[node].skip; child = tree_.nodes[child].skip)
      next[eyeSiding(grid_.place[child], grid_.middleWorld[node], view_->eyeWorld)].push_back(child);
  }
  for (std::size_t sides = next.size(); sides-- > 0;)
    if (!next[sides].empty()) visit(next[sides], depth + 1);
}

void SiblingSchedule::findVisible(const Unit& unit, std::uint32_t depth, Unit& visible) {
  visible.clear();
  asking_.clear();
  for (const std::uint32_t node : unit) {
    if (depth <= options_.planeDepth && !inView(node)) continue;
    if (depth > options_.planeDepth) ++device_->figures().nodesVisited;
    (reachesNear(node) ? visible : asking_).push_back(node);
  }
  askAll(asking_, visible);
}

void SiblingSchedule::askAll(const Unit& nodes, Unit& visible) {
  const std::size_t most = options_.unitsTogether ? device_->capacity() : 1;
  for (std::size_t first = 0; first < nodes.size(); first += most) {
    const std::size_t end = std::min(first + most, nodes.size());
    asked_.clear();
    for (std::size_t i = first; i < end; ++i)
      asked_.push_back(ask(nodes[i]));
    const std::vector<std::uint32_t>& found = passedOf(asked_);
    visible.insert(visible.end(), found.begin(), found.end());
  }
}

}  // namespace jalousie::culling
