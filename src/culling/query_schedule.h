// Which boxes are asked and which objects are drawn, in which order: the methods on hardware occlusion queries, without
// OpenGL (docs/occlusion_queries.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "culling/frustum.h"
#include "culling/hierarchy.h"
#include "culling/query_device.h"
#include "culling/query_options.h"

namespace jalousie::culling {

/// Draws, frame after frame, every object that is visible, and as few others as it can. Conservative with a threshold
/// of 0: what is left out was hidden by objects drawn before, whatever the order. No object is drawn twice in a frame.
/// Answers are taken at points that do not depend on when they arrive, so that two runs do the same.
class QuerySchedule {
 public:
  /// @param tree  outlives the schedule; may be fitted anew between frames. After it was built anew: forget().
  explicit QuerySchedule(const SpatialHierarchy& tree);
  virtual ~QuerySchedule() = default;
  QuerySchedule(const QuerySchedule&) = delete;
  QuerySchedule& operator=(const QuerySchedule&) = delete;

  /// Decides and draws one frame. Allocates nothing but where units of a grid are larger than any before.
  void run(const QueryView& view, const QueryOptions& options, QueryDevice& device);
  /// Forgets past frames. Answers that are still out are taken from the device and dropped.
  void forget(QueryDevice& device);

 protected:
  /// What is kept of a node from frame to frame. Frames count from 1.
  struct History {
    std::uint64_t visited = 0;  ///< last frame in which it was in view and reached
    std::uint64_t visible = 0;  ///< last frame in which it was
    std::uint64_t due = 0;      ///< frame in which a visible leaf asks again
    std::uint32_t hidden = 0;   ///< frames in a row in which it was found hidden
  };
  /// A place in a front-to-back order; equal distances by node.
  struct Place {
    float distance;
    std::uint32_t node;
    friend bool operator<(const Place& a, const Place& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.node < b.node;
    }
  };
  /// A query that is out.
  struct Asked {
    QueryDevice::Ticket ticket;
    std::uint32_t node = 0;
    bool drawn = false;  ///< the node was taken for visible meanwhile
  };

  virtual void decide() = 0;
  /// Takes the answers that the last frame left out.
  virtual void dropPending() {}
  /// Memory for one entry a node.
  void resizeHistory();

  /// Whether a node lies in the view. Tests only planes that its parent crosses, if that was tested in this frame.
  bool inView(std::uint32_t node);
  bool reachesNear(std::uint32_t node) const { return view_->reachesNear(tree_.nodes[node].boundsWorld); }
  bool wasVisible(std::uint32_t node) const;
  /// Marks a node and its ancestors.
  void markVisible(std::uint32_t node, std::uint64_t frame);
  void forgetNode(std::uint32_t node) { history_[node] = {}; }
  void drawLeaf(std::uint32_t leaf);
  Asked ask(std::uint32_t node, bool drawn = false) { return {device_->ask({&node, 1}), node, drawn}; }
  /// Waits for an answer. @return  whether enough samples passed
  bool passed(const QueryDevice::Ticket& ticket) { return device_->answer(ticket) > options_.threshold; }
  bool passed(const Asked& asked) { return passed(asked.ticket); }
  /// The nodes of some queries that passed, in their order. Waits once: for the last one.
  const std::vector<std::uint32_t>& passedOf(std::span<const Asked> asked);
  /// All leaves in view, front to back.
  const std::vector<Place>& leavesInView();
  Place placeOf(std::uint32_t node) const { return {view_->distanceTo(tree_.nodes[node].boundsWorld), node}; }

  const SpatialHierarchy& tree_;
  std::vector<History> history_;  ///< [nodes]
  QueryOptions options_;
  const QueryView* view_ = nullptr;
  QueryDevice* device_ = nullptr;
  std::uint64_t frame_ = 1;  ///< the first one is 2: a history of zeros is older than a frame

 private:
  std::vector<std::uint32_t> planesOf_;     ///< [nodes] that a node crosses
  std::vector<std::uint64_t> planesFrame_;  ///< [nodes] frame of planesOf_
  std::vector<Place> leaves_;
  std::vector<std::uint32_t> passed_;
};

}  // namespace jalousie::culling
