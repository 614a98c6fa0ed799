// Spreads points evenly over a surface and interpolates positions and normals there.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

/// A point of triangle `triangle`.
struct SurfaceSample {
  std::uint32_t triangle = 0;
  glm::vec3 barycentric{0.0F};
};

/// `count` points in proportion to area, in the order of the triangles; a low-discrepancy sequence, the same for the
/// same mesh. Empty if the mesh has no area.
std::vector<SurfaceSample> sampleSurface(const WedgeMesh& mesh, std::size_t count);

/// Object-space position.
glm::vec3 positionAt(const WedgeMesh& mesh, std::uint32_t triangle, const glm::dvec3& barycentric);
/// Unit shading normal: the interpolated NORMAL, or the face normal if there is no NORMAL or it vanishes.
glm::dvec3 shadingNormalAt(const WedgeMesh& mesh, const AttributeSlot* normals, std::uint32_t triangle,
                           const glm::dvec3& barycentric);

/// For each vertex of a mesh one triangle that touches it.
std::vector<std::uint32_t> triangleOfVertex(const WedgeMesh& mesh);

}  // namespace jalousie::bake
