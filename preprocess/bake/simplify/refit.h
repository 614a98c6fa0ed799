// Moves the vertices of a level to fit the original surface (least squares).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/slices.h"

namespace jalousie::bake {

struct RefitOptions {
  std::uint32_t rounds = 2;                     ///< of projecting and solving
  std::uint32_t samplesPerTriangle = 12;        ///< of the level
  double mostSamples = 2.0;                     ///< per triangle of the original
  bool normals = true;                          ///< fit shading normals too
  bool lockBorder = false;                      ///< vertices of open borders keep position and normals
  std::span<const std::uint8_t> locked;         ///< for each vertex of the original 1 if it keeps them; empty: none
  std::span<const std::uint32_t> partOfVertex;  ///< loose part of each vertex of the original; empty: one part
  SliceRunner slices = runInOneSlice;
};

/// Least squares of positions, then of normals, against points of the original. Each point s is projected onto the
/// level, where it lands in a triangle with barycentric weights b; the positions x minimise sum |sum_k b_k x_k - s|^2 +
/// damping sum |x - x_0|^2, solved with conjugate gradients. Triangles that would turn over keep the old
/// positions of their vertices. Points of parts that are gone do not count: the level has nothing that could fit them.
/// Nor do points that land on another part, whose normal disagrees, or that are far beyond the usual distance.
/// @param level     changed in place   @param vertexMap  for each vertex of the original the one of the level it
/// became, or ~0; it starts the searches
void refitLevel(const WedgeMesh& original, std::span<const std::uint32_t> vertexMap, const RefitOptions& options,
                WedgeMesh& level);

/// Undoes the moves of the vertices of triangles that turned over, until no triangle is turned over.
/// @param before, after  positions of the vertices   @param indices  three per triangle, in range
void keepFacing(const std::vector<glm::vec3>& before, std::span<const std::uint32_t> indices,
                std::vector<glm::vec3>& after);

}  // namespace jalousie::bake
