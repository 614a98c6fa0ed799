// Groups of cells in the baked format, for a level per cell: extras.jalousie.cellLevels of a level's mesh.
//
//   "cellLevels": {"producers": [n0, n1, ...], "groups": [g0, g1, ...], "max": [e0, e1, ...], "mean": [e0, e1, ...]}
//
// Groups of the cells of one level are simplified together, each into cells of the next level. A group keeps its outer
// border, so each can be drawn before or after this step (asset/cell_cut.h).
//   producers  for each group of the finer level the number of cells that it became, which follow one another; absent
//              at LOD 0
//   groups     the group of each cell of this level; absent at the last level
//   max, mean  for each group the two-sided distance to LOD 0 of what it became, over sampled points, object-space
//              length; never below those of the groups that its cells come from
// The numbers of a level's filled cells begin with 0; the cells behind them are empty.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <span>
#include <vector>

#include "asset/lod_chain.h"

namespace jalousie::asset {

/// The groups of one level.
struct LodCellLevels {
  std::vector<std::uint32_t> producedCells;  ///< for each group of the finer level; empty at LOD 0
  std::vector<std::uint32_t> groupOf;        ///< of each filled cell; empty at the last level
  std::vector<DistanceInfo> errors;          ///< of each group

  bool empty() const { return producedCells.empty() && groupOf.empty(); }
};

/// Filled cells of a level. @pre it is not empty
std::uint32_t filledCells(const LodCellLevels& level);

/// Adds groups to extras.jalousie. Nothing if empty. @pre setLodCells was called (checked)
void setLodCellLevels(tinygltf::Mesh& mesh, const LodCellLevels& levels);
/// Reads them back; empty if absent. Errors: kMalformed (wrong types, a number out of range, groups without cells,
/// lists that do not fit each other, or cells that are filled and are not counted).
/// @pre the indices of the mesh's accessors are in range
LodCellLevels lodCellLevels(const tinygltf::Model& model, const tinygltf::Mesh& mesh);

/// Whether the levels of a chain fit each other. Errors: kMalformed (a level without groups beside others with them,
/// groups of one level that the next does not count, errors that fall).
void requireHierarchy(std::span<const LodCellLevels> levels);

}  // namespace jalousie::asset
