// Heaps and queues; no recursion.
#include "culling/coherent_schedule.h"

#include <algorithm>

namespace jalousie::culling {
namespace {

/// Order of the heap: the nearest node on top.
bool isFarther(const auto& a, const auto& b) {
  return b < a;
}

/// A number that is the same in every run. Fibonacci hashing.
std::uint32_t hashOf(std::uint32_t node) {
  return static_cast<std::uint32_t>((std::uint64_t{node} + 1) * 11400714819323198485ULL >> 32U);
}

}  // namespace

TraversalSchedule::TraversalSchedule(const SpatialHierarchy& tree) : QuerySchedule(tree) {
  nodesLeft_.reserve(tree.objects.size());
}

CoherentSchedule::CoherentSchedule(const SpatialHierarchy& tree) : TraversalSchedule(tree) {
  asked_.reserve(tree.objects.size());
}

CoherentPlusSchedule::CoherentPlusSchedule(const SpatialHierarchy& tree) : TraversalSchedule(tree) {
  visibleQueue_.reserve(tree.objects.size());
  members_.reserve(tree.objects.size());
  groups_.reserve(tree.objects.size());
  pending_.reserve(tree.objects.size());
}

void TraversalSchedule::push(std::uint32_t node) {
  nodesLeft_.push_back(placeOf(node));
  std::push_heap(nodesLeft_.begin(), nodesLeft_.end(), isFarther<Place, Place>);
}

std::uint32_t TraversalSchedule::pop() {
  std::pop_heap(nodesLeft_.begin(), nodesLeft_.end(), isFarther<Place, Place>);
  const std::uint32_t node = nodesLeft_.back().node;
  nodesLeft_.pop_back();
  return node;
}

void TraversalSchedule::drawOrOpen(std::uint32_t node) {
  if (tree_.isLeaf(node)) {
    drawLeaf(node);
    return;
  }
  for (std::uint32_t child = node + 1; child < tree_.nodes[node].skip; child = tree_.nodes[child].skip)
    push(child);
}

void CoherentSchedule::decide() {
  const std::size_t most = std::min(options_.batch, device_->capacity());
  asked_.clear();
  head_ = 0;
  push(0);
  while (!nodesLeft_.empty() || head_ < asked_.size()) {
    if (nodesLeft_.empty() || asked_.size() - head_ == most) {
      settleOldest();
      continue;
    }
    visit(pop());
  }
}

void CoherentSchedule::visit(std::uint32_t node) {
  if (!inView(node)) {
    forgetNode(node);
    return;
  }
  const bool was = wasVisible(node);
  history_[node].visited = frame_;
  if (reachesNear(node)) {
    markVisible(node, frame_);
    drawOrOpen(node);
    return;
  }
  // An inner node that was visible is visible still if one of its descendants is.
  if (!was || tree_.isLeaf(node)) asked_.push_back(ask(node, was));
  if (was) drawOrOpen(node);
}

void CoherentSchedule::settleOldest() {
  const Asked oldest = asked_[head_++];
  if (!passed(oldest)) return;
  markVisible(oldest.node, frame_);
  if (!oldest.drawn) drawOrOpen(oldest.node);
}

void CoherentPlusSchedule::decide() {
  takeLastFrame();
  hiddenQueue_.clear();
  visibleQueue_.clear();
  members_.clear();
  groups_.clear();
  head_ = 0;
  batches_ = 0;
  push(0);
  while (!nodesLeft_.empty() || !hiddenQueue_.empty() || head_ < groups_.size()) {
    if (!nodesLeft_.empty()) {
      visit(pop());
      if (hiddenQueue_.size() < std::min(options_.batch, device_->capacity() / 4)) continue;
      sendHidden();
      // What was asked before this batch had the time of a batch.
      const std::uint32_t sent = batches_;
      while (groups_[head_].batch < sent)
        settleOldestBatch();
    } else if (!hiddenQueue_.empty()) {
      sendHidden();
    } else {
      settleOldestBatch();
    }
  }
  sendVisible();
}

/// Answers for leaves that the last frame drew: they say what was visible in that frame.
void CoherentPlusSchedule::takeLastFrame() {
  for (std::size_t i = pending_.size(); i-- > 0;) {
    const Asked& asked = pending_[i];
    if (!passed(asked)) continue;
    markVisible(asked.node, frame_ - 1);
    history_[asked.node].due = frame_ + options_.requery;
  }
  pending_.clear();
}

void CoherentPlusSchedule::dropPending() {
  for (const Asked& asked : pending_)
    passed(asked);
  pending_.clear();
}

bool CoherentPlusSchedule::isDue(std::uint32_t node) const {
  return options_.requery == 0 || history_[node].due <= frame_;
}

void CoherentPlusSchedule::visit(std::uint32_t node) {
  if (!inView(node)) {
    forgetNode(node);
    return;
  }
  const bool was = wasVisible(node);
  History& history = history_[node];
  if (history.visited + 1 != frame_) history.hidden = 0;
  history.visited = frame_;
  if (reachesNear(node)) {
    markVisible(node, frame_);
    drawOrOpen(node);
    return;
  }
  if (!was) {
    hiddenQueue_.push_back({node, history.hidden, static_cast<std::uint32_t>(hiddenQueue_.size())});
    return;
  }
  if (tree_.isLeaf(node)) {
    const std::size_t room = device_->capacity() / 2;
    if (isDue(node) && visibleQueue_.size() < room) {
      visibleQueue_.push_back(node);
    } else {
      markVisible(node, frame_);
    }
  }
  drawOrOpen(node);
}

/// Sends the queue in queries of one node or several, the surest first.
void CoherentPlusSchedule::sendHidden() {
  ++batches_;
  if (options_.multiquery != Multiquery::kOff) {
    std::sort(hiddenQueue_.begin(), hiddenQueue_.end(), [](const Waiting& a, const Waiting& b) {
      return a.hidden != b.hidden ? a.hidden > b.hidden : a.order < b.order;
    });
  }
  hidden_.clear();
  for (const Waiting& waiting : hiddenQueue_)
    hidden_.push_back({waiting.hidden, tree_.nodes[waiting.node].objectCount});
  for (std::size_t first = 0; first < hidden_.size();) {
    const std::size_t size = multiquerySize(std::span(hidden_).subspan(first), options_.multiquery);
    sendGroup(first, first + size);
    first += size;
  }
  hiddenQueue_.clear();
}

void CoherentPlusSchedule::sendGroup(std::size_t first, std::size_t end) {
  Group group;
  group.firstMember = static_cast<std::uint32_t>(members_.size());
  group.memberCount = static_cast<std::uint32_t>(end - first);
  group.batch = batches_;
  boxes_.clear();
  for (std::size_t i = first; i < end; ++i) {
    members_.push_back(hiddenQueue_[i].node);
    addBoxes(hiddenQueue_[i].node);
  }
  group.ticket = device_->ask(boxes_);
  groups_.push_back(group);
}

void CoherentPlusSchedule::addBoxes(std::uint32_t node) {
  constexpr int kLevels = 3;
  const std::size_t first = boxes_.size();
  boxes_.push_back(node);
  const double most = double{options_.tightBounds} * surfaceArea(tree_.nodes[node].boundsWorld);
  for (int level = 0; level < kLevels && options_.tightBounds > 0.0F; ++level) {
    finer_.clear();
    double area = 0.0;
    const auto take = [&](std::uint32_t n) {
      finer_.push_back(n);
      area += surfaceArea(tree_.nodes[n].boundsWorld);
    };
    for (std::size_t i = first; i < boxes_.size(); ++i) {
      const std::uint32_t n = boxes_[i];
      if (tree_.isLeaf(n)) take(n);
      for (std::uint32_t child = n + 1; child < tree_.nodes[n].skip; child = tree_.nodes[child].skip)
        take(child);
    }
    if (!(area <= most)) return;
    boxes_.resize(first);
    boxes_.insert(boxes_.end(), finer_.begin(), finer_.end());
  }
}

/// Nodes that a query for several finds visible ask again one by one, in a batch of their own.
void CoherentPlusSchedule::settleOldestBatch() {
  const std::uint32_t batch = groups_[head_].batch;
  std::size_t end = head_;
  while (end < groups_.size() && groups_[end].batch == batch)
    ++end;
  ++batches_;
  while (head_ < end)
    settle(Group(groups_[head_++]));
}

void CoherentPlusSchedule::settle(const Group& group) {
  const bool visible = passed(group.ticket);
  for (std::uint32_t i = group.firstMember; i < group.firstMember + group.memberCount; ++i) {
    const std::uint32_t node = members_[i];
    if (!visible) {
      ++history_[node].hidden;
    } else if (group.memberCount == 1) {
      markVisible(node, frame_);
      const std::uint32_t spread = options_.requery == 0 ? 0 : hashOf(node) % options_.requery;
      history_[node].due = frame_ + 1 + spread;
      drawOrOpen(node);
    } else {
      members_.push_back(node);
      boxes_.clear();
      addBoxes(node);
      groups_.push_back({device_->ask(boxes_), static_cast<std::uint32_t>(members_.size() - 1), 1, batches_});
    }
  }
}

void CoherentPlusSchedule::sendVisible() {
  for (const std::uint32_t node : visibleQueue_) {
    boxes_.clear();
    addBoxes(node);
    pending_.push_back({device_->ask(boxes_), node, true});
  }
}

}  // namespace jalousie::culling
