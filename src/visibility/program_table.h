// Table of the compute programs of the visibility passes; a test builds every row.
#pragma once

#include <span>

#include "gl/program.h"

namespace jalousie::visibility {

enum class ProgramId : unsigned {
  kClassify,
  kReduceMap,
  kAnalyseMap,       ///< kTraitUsesMap alone
  kAnalyseMapDepth,  ///< kTraitUsesMap and kTraitUsesDepth
  kAnalyseDepth,     ///< kTraitUsesDepth alone
  kReduceDepthFirst,
  kReduceDepthFirstCovered,
  kReduceDepth,
  kReduceDepthMinMax,  ///< needs Capabilities::minMaxFilter
  kBinObjects,
  kBinObjectsPerThread,  ///< one thread for each tile
  kScanEntries,
  kScanSums,
  kScatter,
  kScatterPerThread,
  kScatterPerObject,
  kScatterPerObjectAndThread,
  kWriteCommands,
  kWriteCounts,
  kCountStates,
  kCountPixels,
  kMarkGhosts,
  kClassifyCells,
  kAnalyseCellsMap,  ///< as the programs for objects
  kAnalyseCellsMapDepth,
  kAnalyseCellsDepth,
  kCountCells,
  kCountStatesOfCells,  ///< kCountStates in scenes with cells
  kMarkGhostsOfCells,
  kAdjustPrice,
  kBudgetSum,
  kBudgetSumOfCells,  ///< kBudgetSum in scenes with cells
  kBudgetPlan,
  kBudgetForecast,
  kBudgetLimit,
  kSliceCommands,
  kDropHidden,
  kHideObjects,
  kHideCells,
  kFaceRanges,
  kFaceCommands,
  kSliceFaces,
};

/// All programs, in the order of ProgramId.
std::span<const gl::ProgramSource> programTable();
inline const gl::ProgramSource& programSource(ProgramId id) {
  return programTable()[static_cast<unsigned>(id)];
}

}  // namespace jalousie::visibility
