// Welding and normals.
#include "bake/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace jalousie::bake {

std::vector<std::uint32_t> weldByPosition(std::span<const glm::vec3> positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec3& p = positions[a];
    const glm::vec3& q = positions[b];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    if (p.z != q.z) return p.z < q.z;
    return a < b;
  });
  std::vector<std::uint32_t> ids(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    ids[order[i]] = i > 0 && positions[order[i]] == positions[order[i - 1]] ? ids[order[i - 1]] : order[i];
  return ids;
}

glm::dvec3 faceNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 cross = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  const double length = glm::length(cross);
  return length > 0.0 ? cross / length : glm::dvec3(0.0);
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
