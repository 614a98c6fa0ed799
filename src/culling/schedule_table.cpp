// One line per method.
#include "culling/schedule_table.h"

#include "core/check.h"
#include "culling/coherent_schedule.h"
#include "culling/plain_schedule.h"
#include "culling/sibling_schedule.h"
#include "culling/slab_schedule.h"

namespace jalousie::culling {

bool needsGrid(QueryMethod method) {
  return method == QueryMethod::kSlabs || method == QueryMethod::kSiblings;
}

GridOptions gridOptions(QueryMethod method) {
  return {.cellsPerAxis = method == QueryMethod::kSlabs ? kMostCellsPerAxis : 2};
}

std::unique_ptr<QuerySchedule> makeSchedule(QueryMethod method, const SpatialHierarchy& tree, const LooseGrid* grid) {
  switch (method) {
    case QueryMethod::kWait:
      return std::make_unique<WaitSchedule>(tree);
    case QueryMethod::kBatch:
      return std::make_unique<BatchSchedule>(tree);
    case QueryMethod::kCoherentFlat:
      return std::make_unique<CoherentFlatSchedule>(tree);
    case QueryMethod::kCoherent:
      return std::make_unique<CoherentSchedule>(tree);
    case QueryMethod::kCoherentPlus:
      return std::make_unique<CoherentPlusSchedule>(tree);
    case QueryMethod::kDeferred:
      return std::make_unique<DeferredSchedule>(tree);
    case QueryMethod::kSlabs:
    case QueryMethod::kSiblings:
      break;
  }
  const bool hasGrid = grid != nullptr;
  JAL_CHECK(hasGrid);
  if (method == QueryMethod::kSlabs) return std::make_unique<SlabSchedule>(*grid);
  return std::make_unique<SiblingSchedule>(*grid);
}

}  // namespace jalousie::culling
