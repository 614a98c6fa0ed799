// A control mesh of Phong tessellation (Boubekeur and Alexa 2008): its surface, derivatives and tessellations.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

/// Triangles with one position and one normal per vertex, so that neighbouring patches meet.
struct PatchMesh {
  std::vector<glm::vec3> positions;    ///< object space
  std::vector<glm::vec3> normals;      ///< [positions.size()] unit vectors
  std::vector<std::uint32_t> indices;  ///< three per patch, in range
  double alpha = 0.75;                 ///< 0 flat, 1 fully projected
};

/// The vertices of a mesh with smooth normals and the usual alpha: what the program tessellates without a fit.
PatchMesh patchesOf(const WedgeMesh& mesh);

/// The point S(b) = p - alpha sum_k b_k n_k n_k^T (p - x_k), p = sum_k b_k x_k, of one patch with its derivatives.
struct PatchPoint {
  glm::dvec3 point{0.0};
  glm::dvec3 bend{0.0};                  ///< -dS/dalpha
  std::array<glm::dmat3, 3> byPosition;  ///< dS/dx_k
  std::array<glm::dmat3, 3> byNormal;    ///< dS/dn_k within the tangent plane of n_k
};

/// @param barycentric  sum 1   @pre triangle is in range
PatchPoint patchPoint(const PatchMesh& mesh, std::uint32_t triangle, const glm::dvec3& barycentric);

/// What the tessellator of OpenGL makes of one triangle with equal spacing and one level for all edges: rings around
/// the middle. The diagonals between two rings are a choice of the driver.
struct PatchPattern {
  std::vector<glm::dvec3> points;      ///< barycentric
  std::vector<std::uint32_t> indices;  ///< three per triangle, counter-clockwise
};

/// @pre level > 0 (checked)
PatchPattern patchPattern(std::uint32_t level);

/// The tessellated surface with interpolated normals. Triangle t belongs to patch t / (triangles of the pattern).
WedgeMesh tessellate(const PatchMesh& mesh, const PatchPattern& pattern);

}  // namespace jalousie::bake
