// One schedule per method.
#pragma once

#include <cstdint>
#include <memory>

#include "culling/loose_grid.h"
#include "culling/query_schedule.h"

namespace jalousie::culling {

/// The methods, in the order of their history.
enum class QueryMethod : std::uint8_t {
  kWait,          ///< leaves front to back, one query at a time
  kBatch,         ///< leaves front to back, batches of queries
  kCoherentFlat,  ///< leaves front to back; what was visible is drawn before its answer
  kCoherent,      ///< CHC: the same over a hierarchy (Bittner et al. 2004)
  kCoherentPlus,  ///< CHC++: batches, multiqueries, tight bounds (Mattausch et al. 2008)
  kSlabs,         ///< nested grids, slab by slab (Hillesland et al. 2002)
  kSiblings,      ///< units of equal eye-siding over a loose grid
  kDeferred,      ///< as kBatch, but the device decides without telling
};

/// Whether a method works on a LooseGrid.
bool needsGrid(QueryMethod method);
/// The grid of a method that needs one.
GridOptions gridOptions(QueryMethod method);

/// @param tree, grid  outlive the schedule   @param grid  where needsGrid(): the grid that `tree` is of, built with
/// gridOptions()
std::unique_ptr<QuerySchedule> makeSchedule(QueryMethod method, const SpatialHierarchy& tree,
                                            const LooseGrid* grid = nullptr);

}  // namespace jalousie::culling
