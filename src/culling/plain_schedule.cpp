// The order of the leaves is that of leavesInView().
#include "culling/plain_schedule.h"

#include <algorithm>

namespace jalousie::culling {

void WaitSchedule::decide() {
  for (const Place& place : leavesInView())
    if (reachesNear(place.node) || passed(ask(place.node))) drawLeaf(place.node);
}

void BatchSchedule::decide() {
  const std::size_t most = std::min(options_.batch, device_->capacity());
  asked_.clear();
  for (const Place& place : leavesInView()) {
    if (reachesNear(place.node)) {
      drawLeaf(place.node);
      continue;
    }
    asked_.push_back(ask(place.node));
    if (asked_.size() == most) settle();
  }
  settle();
}

void BatchSchedule::settle() {
  for (const std::uint32_t leaf : passedOf(asked_))
    drawLeaf(leaf);
  asked_.clear();
}

void DeferredSchedule::decide() {
  const std::size_t most = std::min(options_.batch, device_->capacity());
  batch_.clear();
  const auto send = [&] {
    if (!batch_.empty()) device_->drawWhereVisible(batch_);
    batch_.clear();
  };
  for (const Place& place : leavesInView()) {
    if (reachesNear(place.node)) {
      drawLeaf(place.node);
      continue;
    }
    const HierarchyNode& leaf = tree_.nodes[place.node];
    batch_.push_back({ask(place.node).ticket.query, leaf.firstObject, leaf.objectCount});
    if (batch_.size() == most) send();
  }
  send();
}

void CoherentFlatSchedule::decide() {
  const std::size_t most = std::min(options_.batch, device_->capacity());
  asked_.clear();
  head_ = 0;
  for (const Place& place : leavesInView()) {
    const bool was = wasVisible(place.node);
    history_[place.node].visited = frame_;
    if (reachesNear(place.node)) {
      history_[place.node].visible = frame_;
      drawLeaf(place.node);
      continue;
    }
    asked_.push_back(ask(place.node, was));
    if (was) drawLeaf(place.node);
    if (asked_.size() - head_ == most) settleOldest();
  }
  while (head_ < asked_.size())
    settleOldest();
}

void CoherentFlatSchedule::settleOldest() {
  const Asked& oldest = asked_[head_++];
  if (!passed(oldest)) return;
  history_[oldest.node].visible = frame_;
  if (!oldest.drawn) drawLeaf(oldest.node);
}

}  // namespace jalousie::culling
