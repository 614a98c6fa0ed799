// Normals, bounds and counts of the Phong tessellation path (thesis 4.1.3; Boubekeur and Alexa 2008).
#include "scene/patch_base.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace jalousie::scene {
namespace {

bool lessPosition(const glm::vec3& a, const glm::vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// For each vertex, the lowest vertex with the same position.
std::vector<std::uint32_t> weldedIds(std::span<const glm::vec3> positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return lessPosition(positions[a], positions[b]); });
  std::vector<std::uint32_t> ids(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    ids[order[i]] = same ? ids[order[i - 1]] : order[i];
  }
  return ids;
}

glm::vec3 projectOntoPlane(const glm::vec3& p, const glm::vec3& origin, const glm::vec3& normal) {
  return p - glm::dot(p - origin, normal) * normal;
}

}  // namespace

std::vector<glm::vec3> averagedNormals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
  const std::vector<std::uint32_t> ids = weldedIds(positions);
  std::vector<glm::vec3> sums(positions.size(), glm::vec3(0.0F));
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    const std::array<std::uint32_t, 3> corner = {indices[t], indices[t + 1], indices[t + 2]};
    const glm::vec3 cross =
        glm::cross(positions[corner[1]] - positions[corner[0]], positions[corner[2]] - positions[corner[0]]);
    const float area = glm::length(cross);
    if (!(area > 0.0F)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 a = positions[corner[(k + 1) % 3]] - positions[corner[k]];
      const glm::vec3 b = positions[corner[(k + 2) % 3]] - positions[corner[k]];
      const float angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
      sums[ids[corner[k]]] += angle / area * cross;
    }
  }
  std::vector<glm::vec3> normals(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const glm::vec3& sum = sums[ids[v]];
    const float length = glm::length(sum);
    normals[v] = length > 0.0F ? sum / length : glm::vec3(0.0F, 1.0F, 0.0F);
  }
  return normals;
}

glm::vec3 phongPoint(const glm::vec3& barycentric, std::span<const glm::vec3, 3> corners,
                     std::span<const glm::vec3, 3> normals, float alpha) {
  const glm::vec3 flat = barycentric.x * corners[0] + barycentric.y * corners[1] + barycentric.z * corners[2];
  glm::vec3 curved(0.0F);
  for (int k = 0; k < 3; ++k)
    curved += barycentric[k] *
              projectOntoPlane(flat, corners[static_cast<std::size_t>(k)], normals[static_cast<std::size_t>(k)]);
  return glm::mix(flat, curved, alpha);
}

float phongError(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                 std::span<const std::uint32_t> indices, float alpha) {
  float largest = 0.0F;
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = indices[t + k];
      const std::uint32_t j = indices[t + (k + 1) % 3];
      const glm::vec3 curved = 0.5F * (projectOntoPlane(positions[j], positions[i], normals[i]) +
                                       projectOntoPlane(positions[i], positions[j], normals[j]));
      largest = std::max(largest, alpha * glm::distance(curved, 0.5F * (positions[i] + positions[j])));
    }
  }
  return 2.0F / 3.0F * largest;
}

Aabb phongBounds(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                 std::span<const std::uint32_t> indices, float alpha) {
  Aabb box;
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = indices[t + k];
      const std::uint32_t j = indices[t + (k + 1) % 3];
      const glm::vec3& pi = positions[i];
      const glm::vec3& pj = positions[j];
      const glm::vec3 curved = 0.5F * (projectOntoPlane(pj, pi, normals[i]) + projectOntoPlane(pi, pj, normals[j]));
      box.add(pi);
      box.add(glm::mix(0.5F * (pi + pj), curved, alpha));
    }
  }
  return box;
}

std::uint32_t tessellatedTriangles(std::uint32_t level) {
  std::uint32_t triangles = level % 2 == 1 ? 1 : 0;
  for (std::uint32_t n = level; n >= 2; n -= 2)
    triangles += 6 * (n - 1);
  return triangles;
}

}  // namespace jalousie::scene
