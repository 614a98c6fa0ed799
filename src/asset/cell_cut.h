// Which cells of which levels of a chain are drawn together, if groups of cells choose their levels.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "asset/lod_cell_levels.h"
#include "core/aabb.h"

namespace jalousie::asset {

/// A cut through the levels of a chain: for each level but the last, and each of its groups, 1 if the group is drawn as
/// what it became (coarse), 0 if it is drawn as its cells, or finer.
using CellCut = std::vector<std::vector<std::uint8_t>>;

/// The groups of all levels of a chain.
class CellHierarchy {
 public:
  /// @param levels  LOD 0 first, which fit each other (requireHierarchy)
  explicit CellHierarchy(std::vector<LodCellLevels> levels);

  std::size_t levels() const { return levels_.size(); }
  std::uint32_t groups(std::size_t level) const { return static_cast<std::uint32_t>(levels_[level].errors.size()); }
  std::uint32_t cells(std::size_t level) const { return static_cast<std::uint32_t>(cellsOf_[level]); }
  /// @pre level is not the last one
  std::uint32_t groupOf(std::size_t level, std::uint32_t cell) const { return levels_[level].groupOf[cell]; }
  /// The group of the finer level that a cell comes from. @pre level is not 0
  std::uint32_t producerOf(std::size_t level, std::uint32_t cell) const { return producers_[level][cell]; }
  const DistanceInfo& error(std::size_t level, std::uint32_t group) const { return levels_[level].errors[group]; }

  /// The cut that draws all of one level.
  CellCut uniform(std::size_t level) const;
  /// Whether no group is coarse although one that its cells come from is not. Cells of a legal cut meet without
  /// a crack, and none covers another.
  bool isLegal(const CellCut& cut) const;
  /// Makes groups fine until the cut is legal, from the finest level on: the largest legal cut that it holds.
  void makeLegal(CellCut& cut) const;
  /// Whether a legal cut draws a cell: its producer is coarse and its group is not.
  bool isDrawn(const CellCut& cut, std::size_t level, std::uint32_t cell) const;

 private:
  std::vector<LodCellLevels> levels_;
  std::vector<std::vector<std::uint32_t>> producers_;  ///< by level and cell
  std::vector<std::uint32_t> cellsOf_;                 ///< by level
};

/// For each level but the last the box of each group: around its cells and around the boxes of the groups that these
/// come from, so that boxes grow with the hierarchy. @param cellBoxes  by level and cell
std::vector<std::vector<Aabb>> groupBoxes(const CellHierarchy& hierarchy,
                                          const std::vector<std::vector<Aabb>>& cellBoxes);

/// Which deviation of what a group became decides.
enum class CutBy : std::uint8_t { kLargest, kMean };

/// Makes a group coarse if the deviation of what it became is at most `slope` times the distance of the eye to
/// its box. The cut is legal without further ado, because errors and boxes grow with the hierarchy.
/// @param boxes  from groupBoxes   @param eye  object space
/// @param slope  length per length; for p pixels on a screen of height h with the vertical field of view a it is
/// 2 p tan(a / 2) / h
CellCut cutForEye(const CellHierarchy& hierarchy, const std::vector<std::vector<Aabb>>& boxes, const glm::dvec3& eye,
                  double slope, CutBy by = CutBy::kLargest);
/// Makes a group coarse if the deviation of what it became is at most a length.
CellCut cutForError(const CellHierarchy& hierarchy, double error, CutBy by = CutBy::kLargest);

/// 0 inside of the box. @pre the box is not empty
double distanceToBox(const glm::dvec3& point, const Aabb& box);

}  // namespace jalousie::asset
