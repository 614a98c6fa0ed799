// One level of a chain.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/deviation.h"

namespace jalousie::bake {

/// Cells of a level, for a choice of the level cell by cell (docs/lod_chain.md, "A level per cell"). Groups of
/// neighbouring cells are simplified together while their outer borders stay, and what becomes of a group is divided
/// into cells of the next level.
struct CellDivision {
  std::vector<std::uint32_t> cellOf;      ///< of each triangle
  std::vector<std::uint32_t> producerOf;  ///< of each cell the group of the level before, ascending; empty at LOD 0
  std::vector<std::uint32_t> groupOf;     ///< of each cell its group of this level; empty at the last level
  /// For each group of this level the error of what becomes of it, two-sided distances of points, object-space length;
  /// never below that of the groups that its cells come from.
  std::vector<Distances> errors;
  std::uint32_t cells = 0;
};

struct ChainLevel {
  WedgeMesh mesh;
  Deviation deviation;
  double errorMax = 0.0;           ///< object-space length: the two-sided maximum up to this level, so it never falls
  std::uint32_t removedParts = 0;  ///< loose parts of the mesh that the level is without, if they were removed whole
  std::optional<double> target;    ///< object-space length: the error that was asked for
  std::optional<CellDivision> cells;
};

/// A level that is done.
struct LevelDone {
  std::size_t level = 0;   ///< LOD 0 counts as 0
  std::size_t wanted = 0;  ///< levels that the options ask for, LOD 0 included
  std::uint32_t triangles = 0;
};
using LevelProgress = std::function<void(const LevelDone&)>;

}  // namespace jalousie::bake
