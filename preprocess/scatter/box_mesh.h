// Meshes of axis-aligned boxes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/aabb.h"

namespace jalousie::scatter {

/// Indexed triangles with one normal per vertex.
struct PlainMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<std::uint32_t> indices;
};

/// Adds a parallelogram of two triangles; its normal is cross(u, v).
void addQuad(PlainMesh& mesh, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v);

/// Adds the six faces of a box, normals outward. Adds nothing for a box without width (x) or height (y).
void addBox(PlainMesh& mesh, const Aabb& box);

}  // namespace jalousie::scatter
