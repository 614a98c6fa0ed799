// Occlusion queries over nested grids, slab by slab (Hillesland et al. 2002).
#pragma once

#include <vector>

#include "culling/loose_grid.h"
#include "culling/query_schedule.h"

namespace jalousie::culling {

/// Visits the cells of a grid in slabs across the axis along which the camera looks most, the nearest slab first. The
/// cells of a slab ask in batches; those that are visible are drawn, or their own grids are visited, before the next
/// batch asks. So queries of different grids never wait together.
class SlabSchedule : public QuerySchedule {
 public:
  /// @param grid  outlives the schedule
  explicit SlabSchedule(const LooseGrid& grid) : QuerySchedule(grid.tree), grid_(grid) {}

 private:
  /// A child of the node that is visited.
  struct Child {
    int slab;  ///< from the eye on; the node's own objects come first
    Place place;
    friend bool operator<(const Child& a, const Child& b) {
      return a.slab != b.slab ? a.slab < b.slab : a.place < b.place;
    }
  };
  struct Level {
    std::vector<Child> children;
    std::vector<std::uint32_t> visible;  ///< of one batch
  };

  void decide() override;
  void visit(std::uint32_t node, std::size_t depth);
  void collect(std::uint32_t node, std::vector<Child>& children);
  /// Asks for a batch and puts what is visible into `level.visible`.
  void askBatch(std::size_t first, std::size_t end, Level& level);

  const LooseGrid& grid_;
  int axis_ = 0;
  bool upwards_ = true;        ///< the camera looks along the axis, not against it
  std::vector<Level> levels_;  ///< [depth]
  std::vector<Asked> asked_;
};

}  // namespace jalousie::culling
