// Puts neighbouring cells of a level into groups that are simplified together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

/// Cells of one level.
struct LevelCells {
  std::span<const std::uint32_t> ofTriangle;  ///< cell of each triangle
  std::span<const std::uint32_t> producerOf;  ///< of each cell the group that it comes from; empty at LOD 0
  std::uint32_t count = 0;
};

inline constexpr std::uint32_t kCellsPerGroup = 8;

/// Joins cells, the smallest group first, with the neighbour that it shares most vertices with for its size. Vertices
/// between cells of different producers count more: they were locked when the level was made, and should lie inside a
/// group now. Cells without common vertices are joined by place. A group has at most kCellsPerGroup * trianglesPerCell
/// triangles, or is one cell.
/// @return  the group of each cell; groups are numbered in the order of their first cell
std::vector<std::uint32_t> groupCells(const WedgeMesh& mesh, const LevelCells& cells, std::uint32_t trianglesPerCell);

/// For each vertex 1 if triangles of several groups meet there. @param groupOfTriangle  of each triangle
std::vector<std::uint8_t> verticesBetween(const WedgeMesh& mesh, std::span<const std::uint32_t> groupOfTriangle);

/// Divides the triangles of each group into cells along the cells of a k-d tree. A loose part of at most half a cell
/// stays in one cell, so that no border cuts through a leaf.
/// @param groupOfTriangle  below groups   @param producerOf  gets the group of each cell, ascending
/// @return  the cell of each triangle
std::vector<std::uint32_t> divideGroups(const WedgeMesh& mesh, std::span<const std::uint32_t> groupOfTriangle,
                                        std::uint32_t trianglesPerCell, std::vector<std::uint32_t>& producerOf);

}  // namespace jalousie::bake
