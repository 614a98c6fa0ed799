// The loose grid of the visibility pipeline on queries, with the hierarchy over it and eye-siding.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "culling/hierarchy.h"

namespace jalousie::culling {

/// Place of a node that is not an octant of its parent: the objects that are too large for the parent's children.
inline constexpr std::uint8_t kOwnObjects = 8;

/// A grid of cubic voxels. An object belongs to the voxel that holds the lower corner of its box and reaches at most
/// one voxel beyond it; larger objects belong to a node above. The tree halves each axis that is longer than one voxel.
struct LooseGrid {
  SpatialHierarchy tree;               ///< boxes fit the objects; leaves are voxels, or objects of an inner node
  std::vector<glm::vec3> middleWorld;  ///< [nodes] where an inner node is halved
  std::vector<std::uint8_t> octant;    ///< [nodes] bit a: the upper half of axis a of its parent; or kOwnObjects
  float voxelSide = 0.0F;              ///< world units
};

/// @param boundsWorld  min <= max, no NaN (checked)   @param voxelSize  side of a voxel over the mean of the boxes'
/// largest extents, > 0; at most 1024 voxels lie on an axis, so that voxels may become larger
LooseGrid buildGrid(std::span<const Aabb> boundsWorld, float voxelSize = 2.0F);

/// On how many axes an octant lies on the eye's side of its parent's middle, 0 to 3. A ray from the eye crosses each
/// middle at most once, so of two octants only the one with more can hide something of the other; octants with equal
/// numbers cannot hide each other.
std::uint32_t eyeSiding(std::uint8_t octant, const glm::vec3& middleWorld, const glm::vec3& eyeWorld);

}  // namespace jalousie::culling
