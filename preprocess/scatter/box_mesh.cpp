// Four vertices for each face, because normals are flat.
#include "scatter/box_mesh.h"

namespace jalousie::scatter {

void addQuad(PlainMesh& mesh, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {origin, origin + u, origin + u + v, origin + v});
  mesh.normals.insert(mesh.normals.end(), 4, glm::normalize(glm::cross(u, v)));
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

void addBox(PlainMesh& mesh, const Aabb& box) {
  if (!(box.max.x > box.min.x) || !(box.max.y > box.min.y)) return;
  const glm::vec3& a = box.min;
  const glm::vec3 x(box.max.x - a.x, 0.0F, 0.0F);
  const glm::vec3 y(0.0F, box.max.y - a.y, 0.0F);
  const glm::vec3 z(0.0F, 0.0F, box.max.z - a.z);
  addQuad(mesh, a + z, x, y);
  addQuad(mesh, a, y, x);
  addQuad(mesh, a + x, y, z);
  addQuad(mesh, a, z, y);
  addQuad(mesh, a + y, z, x);
  addQuad(mesh, a, x, z);
}

}  // namespace jalousie::scatter
