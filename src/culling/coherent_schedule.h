// Coherent hierarchical culling: CHC (Bittner et al. 2004) and CHC++ (Mattausch et al. 2008).
#pragma once

#include <vector>

#include "culling/multiquery.h"
#include "culling/query_schedule.h"

namespace jalousie::culling {

/// A traversal front to back over a hierarchy.
class TraversalSchedule : public QuerySchedule {
 public:
  explicit TraversalSchedule(const SpatialHierarchy& tree);

 protected:
  void push(std::uint32_t node);
  /// The nearest node of the traversal. @pre !nodesLeft_.empty()
  std::uint32_t pop();
  /// Draws a leaf, or puts the children of an inner node into the traversal.
  void drawOrOpen(std::uint32_t node);

  std::vector<Place> nodesLeft_;  ///< heap, the nearest first
};

/// CHC: asks for leaves and for nodes that were hidden; opens inner nodes that were visible without a query.
class CoherentSchedule : public TraversalSchedule {
 public:
  explicit CoherentSchedule(const SpatialHierarchy& tree);

 private:
  void decide() override;
  void visit(std::uint32_t node);
  void settleOldest();

  std::vector<Asked> asked_;  ///< first in, first out, from head_
  std::size_t head_ = 0;
};

/// CHC++: queries are collected in two queues and sent in batches. Nodes that were hidden ask together where they are
/// likely to be hidden still; visible leaves ask every few frames, at the end of the frame, for the next one.
class CoherentPlusSchedule : public TraversalSchedule {
 public:
  explicit CoherentPlusSchedule(const SpatialHierarchy& tree);

 private:
  /// A query for one node or several.
  struct Group {
    QueryDevice::Ticket ticket;
    std::uint32_t firstMember = 0;  ///< in members_
    std::uint32_t memberCount = 0;
    std::uint32_t batch = 0;
  };
  /// A node that waits for its query.
  struct Waiting {
    std::uint32_t node;
    std::uint32_t hidden;  ///< frames in a row
    std::uint32_t order;   ///< in the queue
  };

  void decide() override;
  void dropPending() override;
  void takeLastFrame();
  void visit(std::uint32_t node);
  bool isDue(std::uint32_t node) const;
  void sendHidden();
  void sendGroup(std::size_t first, std::size_t end);
  void settleOldestBatch();
  void settle(const Group& group);
  void sendVisible();
  /// Boxes of a node, appended to boxes_.
  void addBoxes(std::uint32_t node);

  std::vector<Waiting> hiddenQueue_;
  std::vector<HiddenNode> hidden_;  ///< of the queue
  std::vector<std::uint32_t> visibleQueue_;
  std::vector<std::uint32_t> members_;  ///< of the groups of this frame
  std::vector<Group> groups_;           ///< first in, first out, from head_
  std::size_t head_ = 0;
  std::uint32_t batches_ = 0;
  std::vector<Asked> pending_;  ///< of the last frame
  std::vector<std::uint32_t> boxes_;
  std::vector<std::uint32_t> finer_;
};

}  // namespace jalousie::culling
