// Sums of face normals over welded positions.
#include "bake/mesh/normals.h"

#include <cmath>

#include "bake/mesh/weld.h"

namespace jalousie::bake {

glm::dvec3 faceNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 cross = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  const double length = glm::length(cross);
  return length > 0.0 ? cross / length : glm::dvec3(0.0);
}

double triangleArea(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return 0.5 * glm::length(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
}

std::vector<glm::vec3> smoothNormals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
  const std::vector<std::uint32_t> ids = weldByPosition(positions);
  std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0.0));
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    const glm::dvec3 normal = faceNormal(positions[indices[t]], positions[indices[t + 1]], positions[indices[t + 2]]);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 corner(positions[indices[t + k]]);
      const glm::dvec3 a = glm::dvec3(positions[indices[t + (k + 1) % 3]]) - corner;
      const glm::dvec3 b = glm::dvec3(positions[indices[t + (k + 2) % 3]]) - corner;
      sums[ids[indices[t + k]]] += std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * normal;
    }
  }
  std::vector<glm::vec3> normals(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const glm::dvec3& sum = sums[ids[v]];
    const double length = glm::length(sum);
    normals[v] = length > 1e-12 ? glm::vec3(sum / length) : glm::vec3(0.0F, 1.0F, 0.0F);
  }
  return normals;
}

}  // namespace jalousie::bake
