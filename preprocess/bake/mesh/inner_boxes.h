// Boxes inside of closed surfaces: what hides everything behind a mesh, whatever level of it is drawn.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bake/mesh/level_surface.h"
#include "core/aabb.h"

namespace jalousie::bake {

/// Whether each edge, between places, belongs to as many triangles in one direction as in the other. A line to infinity
/// then enters the surface as often as it leaves it.
bool isClosed(const LevelSurface& surface);

/// How often a closed surface winds around a point that is not on it: 1 inside, 0 outside, -1 where it is inside out,
/// 2 where two parts overlap. The sum of the solid angles of all triangles over 4 pi.
double windingNumber(const LevelSurface& surface, const glm::dvec3& point);

struct InnerBoxOptions {
  std::uint32_t cells = 32;  ///< of the grid that boxes are found in, along each side; at most 64
  std::uint32_t boxes = 3;   ///< at most so many
  double least = 0.02;       ///< smallest volume, as a share of that of the surface's box
  bool insideOut = false;    ///< surfaces that wind the other way count, too: both sides are drawn
};

/// Boxes without a common point with any triangle of any level, around which every level winds: each level hides what a
/// box hides. Largest first. Found on a grid of cells that no triangle touches, then grown until they nearly touch the
/// surface. Deterministic. @param levels  closed (isClosed), not empty
std::vector<Aabb> innerBoxes(std::span<const LevelSurface> levels, const InnerBoxOptions& options = {});

/// Whether a box has no common point with any triangle of the levels, and all of them wind around it.
bool liesInside(const Aabb& box, std::span<const LevelSurface> levels, bool insideOut = false);

}  // namespace jalousie::bake
