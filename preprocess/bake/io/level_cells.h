// Divides the triangles of a chain's levels into spatial cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "asset/lod_cell_levels.h"
#include "bake/mesh/combined_mesh.h"
#include "bake/simplify/chain.h"
#include "core/cell_tree.h"

namespace jalousie::bake {

struct CellOptions {
  std::uint32_t trianglesPerCell = 256;  ///< most triangles of LOD 0 in a cell; 0: no cells
  bool onlyLarge = true;                 ///< leave meshes of at most two cells undivided
  bool levels = false;                   ///< every cell can have a level of its own
};

/// The most triangles of a cell of this mesh by the options; 0 if it is not divided.
std::uint32_t cellTriangles(const CombinedMesh& finest, const CellOptions& options);

/// The division of a chain. A table has a number for each cell, primitive and level. So that it stays small beside the
/// triangles, a cell has at least kLeastPerPrimitive triangles for each primitive, even if the options ask for fewer.
/// @param finest  LOD 0, positions finite   @return  nullopt if there would be one cell, or by the options
std::optional<CellTree> divideIntoCells(const CombinedMesh& finest, const CellOptions& options);

inline constexpr std::uint32_t kLeastPerPrimitive = 8;

/// The triangles of a level in the order of cells; all in one cell if there is no tree. @param level  positions finite
CellOrder orderByCells(const CombinedMesh& level, const std::optional<CellTree>& tree);

/// The order of level k, and the table of its groups. @pre the levels have cells of their own
CellOrder orderByCells(const LevelChain& chain, std::size_t k);
asset::LodCellLevels cellLevelsOf(const LevelChain& chain, std::size_t k);

}  // namespace jalousie::bake
