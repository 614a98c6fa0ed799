// Objects that lie in the shadow of an occluder, found by a traversal of the spatial hierarchy.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "culling/active_set.h"
#include "culling/query_figures.h"

namespace jalousie::culling {

/// By how much a box is grown on all sides before it is tested against a shadow: as the box of a query, and by the
/// rounding of coordinates. Silhouettes of snapped vertices, and depths that are equal but for rounding, then do not
/// matter. A box in another one grows by at most as much.
float shadowGrowth(const QueryView& view, const Aabb& boxWorld);

/// The flat test: whether a grown box lies in one of the shadows. The traversal agrees with it, object by object.
bool isShaded(const QueryView& view, std::span<const CastShadow> shadows, const Aabb& boxWorld);

/// Tests a hierarchy against shadows.
class OccluderCulling {
 public:
  /// @param nodes  most nodes of a hierarchy
  OccluderCulling(std::size_t nodes, std::size_t objects);

  /// Verdicts of one frame. Nodes in a shadow are not opened; shadows that miss a node are not tested below it. What is
  /// outside of the view stays unmarked. Allocates nothing where the hierarchy is not larger than was said.
  /// @param shadows  at most kMostActive   @param figures  nodes and plane tests are added
  /// @return  [(objects + 31) / 32] a bit for each place of tree.objects: 1 where it is not hidden
  std::span<const std::uint32_t> cull(const SpatialHierarchy& tree, const QueryView& view,
                                      std::span<const CastShadow> shadows, QueryFigures& figures);

 private:
  /// What is left to be tested below a node.
  struct Open {
    std::uint32_t planes = 0;   ///< of the view
    std::uint32_t shadows = 0;  ///< that may hide a part
  };
  struct Test {
    bool hidden = false;
    std::uint32_t shadows = 0;
  };
  Test test(const QueryView& view, std::span<const CastShadow> shadows, std::uint32_t among, const Aabb& box,
            QueryFigures& figures) const;
  void hide(std::uint32_t first, std::uint32_t count);

  std::vector<Open> open_;                ///< [nodes]
  std::vector<std::uint32_t> notHidden_;  ///< bits by place
};

}  // namespace jalousie::culling
