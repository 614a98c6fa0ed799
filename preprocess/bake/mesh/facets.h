// Large rectangles in flat parts of a surface: what hides everything behind it without being closed.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bake/mesh/level_surface.h"

namespace jalousie::bake {

/// A rectangle that lies in flat, connected triangles.
struct Facet {
  std::array<glm::vec3, 4> corners;  ///< counter-clockwise as the triangles are seen, object space
  bool bothSides = false;            ///< all triangles are drawn from both sides
  double area = 0.0;
};

struct FacetOptions {
  std::uint32_t cells = 48;  ///< of the grid on a flat part, along each side
  std::uint32_t facets = 4;  ///< at most so many
  double least = 0.01;       ///< smallest area, as a share of the square of the diagonal of the surface's box
};

/// Largest first. Triangles are taken together that share an edge and lie in one plane, within a millionth of the
/// diagonal. A grid on them is marked where the border of the part touches a cell; the largest rectangle of cells
/// without border, whose middles lie in triangles, has no gap. Deterministic.
/// @param drawnFromBothSides  by triangle: not 0 where both sides are drawn
std::vector<Facet> largeFacets(const LevelSurface& surface, std::span<const std::uint8_t> drawnFromBothSides,
                               const FacetOptions& options = {});

}  // namespace jalousie::bake
