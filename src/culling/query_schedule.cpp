// What all schedules share.
#include "culling/query_schedule.h"

#include <algorithm>

#include "core/check.h"

namespace jalousie::culling {

QuerySchedule::QuerySchedule(const SpatialHierarchy& tree) : tree_(tree) {
  resizeHistory();
}

void QuerySchedule::resizeHistory() {
  // A tree that is built anew may have other nodes, but fewer than two an object.
  history_.reserve(2 * tree_.objects.size());
  planesOf_.reserve(2 * tree_.objects.size());
  planesFrame_.reserve(2 * tree_.objects.size());
  leaves_.reserve(tree_.objects.size());
  history_.assign(tree_.nodes.size(), {});
  planesOf_.assign(tree_.nodes.size(), kAllPlanes);
  planesFrame_.assign(tree_.nodes.size(), 0);
}

void QuerySchedule::run(const QueryView& view, const QueryOptions& options, QueryDevice& device) {
  JAL_CHECK(options.batch >= 1U);
  view_ = &view;
  options_ = options;
  device_ = &device;
  ++frame_;
  const auto start = std::chrono::steady_clock::now();
  const std::chrono::nanoseconds inside = device.timeInside();
  if (!tree_.nodes.empty()) decide();
  const std::chrono::nanoseconds all = std::chrono::steady_clock::now() - start;
  device.figures().decisionNs += static_cast<std::uint64_t>((all - (device.timeInside() - inside)).count());
}

void QuerySchedule::forget(QueryDevice& device) {
  device_ = &device;
  dropPending();
  resizeHistory();
}

bool QuerySchedule::inView(std::uint32_t node) {
  ++device_->figures().nodesVisited;
  const HierarchyNode& n = tree_.nodes[node];
  const bool known = n.parent != kNoParent && planesFrame_[n.parent] == frame_;
  const std::uint32_t planes = known ? planesOf_[n.parent] : kAllPlanes;
  const PlaneTests tests = view_->frustum.test(n.boundsWorld, planes);
  device_->figures().planeTests += tests.tested;
  planesFrame_[node] = frame_;
  planesOf_[node] = tests.crossed;
  return !tests.outside;
}

bool QuerySchedule::wasVisible(std::uint32_t node) const {
  const History& history = history_[node];
  return history.visited + 1 == frame_ && history.visible + 1 == frame_;
}

void QuerySchedule::markVisible(std::uint32_t node, std::uint64_t frame) {
  for (std::uint32_t n = node; n != kNoParent && history_[n].visible != frame; n = tree_.nodes[n].parent) {
    history_[n].visible = frame;
    history_[n].hidden = 0;
  }
}

void QuerySchedule::drawLeaf(std::uint32_t leaf) {
  device_->draw(tree_.nodes[leaf].firstObject, tree_.nodes[leaf].objectCount);
}

/// The last answer comes first: when it is there, all others are.
const std::vector<std::uint32_t>& QuerySchedule::passedOf(std::span<const Asked> asked) {
  passed_.clear();
  for (std::size_t i = asked.size(); i-- > 0;)
    if (passed(asked[i])) passed_.push_back(asked[i].node);
  std::reverse(passed_.begin(), passed_.end());
  return passed_;
}

const std::vector<QuerySchedule::Place>& QuerySchedule::leavesInView() {
  leaves_.clear();
  std::uint32_t n = 0;
  while (n < tree_.nodes.size()) {
    const bool leaf = tree_.isLeaf(n);
    const bool in = inView(n);
    if (in && leaf) leaves_.push_back(placeOf(n));
    if (!in && leaf) forgetNode(n);
    n = in ? n + 1 : tree_.nodes[n].skip;
  }
  std::sort(leaves_.begin(), leaves_.end());
  return leaves_;
}

}  // namespace jalousie::culling
