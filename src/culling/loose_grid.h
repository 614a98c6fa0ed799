// The loose grid of the visibility pipeline on queries, with the hierarchy over it and eye-siding.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "culling/spatial_hierarchy.h"

namespace jalousie::culling {

/// Where a node lies in its parent.
struct GridPlace {
  glm::u8vec3 cell{0};     ///< along each axis, counted from its lower end
  bool ownObjects = true;  ///< no cell: the objects that are too large for the parent's cells
};

/// A grid of cubic voxels. An object belongs to the voxel that holds the lower corner of its box and reaches at most
/// one voxel beyond it; larger objects belong to a node above. The tree divides each axis that is longer than one
/// voxel. Each inner node has two children at least, so that there are fewer than two nodes an object.
struct LooseGrid {
  SpatialHierarchy tree;               ///< boxes fit the objects; leaves are voxels, or objects of an inner node
  std::vector<glm::vec3> middleWorld;  ///< [nodes] where the second cell of an inner node begins on each axis
  std::vector<GridPlace> place;        ///< [nodes] the root's means nothing
  float voxelSide = 0.0F;              ///< world units
};

struct GridOptions {
  float voxelSize = 2.0F;  ///< side of a voxel over the mean of the boxes' largest extents, > 0 (checked)
  /// Cells into which a node is divided on each axis, 2 to kMostCellsPerAxis (checked): 2 for an octree, more for grids
  /// in the cells of a grid.
  std::uint32_t cellsPerAxis = 2;
};
inline constexpr std::uint32_t kMostCellsPerAxis = 4;

/// @param boundsWorld  min <= max, no NaN (checked). At most 1024 voxels lie on an axis, so that voxels may become
/// larger than they should be.
LooseGrid buildGrid(std::span<const Aabb> boundsWorld, const GridOptions& options = {});
/// Builds a grid anew in its own memory: allocates nothing where it holds as many nodes and objects.
void rebuildGrid(LooseGrid& grid, std::span<const Aabb> boundsWorld, const GridOptions& options = {});

/// On how many axes a cell of a halved node lies on the eye's side of its parent's middle, 0 to 3. A ray from the eye
/// crosses each middle at most once, so of two cells only the one with more can hide something of the other; cells with
/// equal numbers cannot hide each other. 3 for a node's own objects.
std::uint32_t eyeSiding(const GridPlace& place, const glm::vec3& middleWorld, const glm::vec3& eyeWorld);

}  // namespace jalousie::culling
