// Normals for the corners of triangles: those of the file, or from the faces around, up to creases.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bake/io/polygon_mesh.h"

namespace jalousie::bake {

struct CornerNormals {
  std::vector<std::uint32_t> ofCorner;  ///< for each corner of the triangles; kNoIndex: none
  std::vector<glm::vec3> values;        ///< unit
};

/// @param corners  the triangles, as indices of mesh.corners   @param faces  the face of each triangle
CornerNormals cornerNormals(const PolygonMesh& mesh, std::span<const std::uint32_t> corners,
                            std::span<const std::uint32_t> faces, NormalRule rule);

}  // namespace jalousie::bake
