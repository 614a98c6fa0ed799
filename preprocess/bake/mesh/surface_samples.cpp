// Samples in proportion to area and interpolates with barycentric weights.
#include "bake/mesh/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "bake/mesh/normals.h"

namespace jalousie::bake {
namespace {

/// Fractional parts of k times two constants of the plastic number: an even sequence in the unit square (Roberts 2018).
glm::dvec2 spread(std::uint64_t k) {
  const double x = 0.5 + 0.7548776662466927 * static_cast<double>(k);
  const double y = 0.5 + 0.5698402909980532 * static_cast<double>(k);
  return {x - std::floor(x), y - std::floor(y)};
}

double areaOf(const WedgeMesh& mesh, std::uint32_t t) {
  const std::size_t first = 3 * std::size_t{t};
  return triangleArea(mesh.positions[mesh.vertexAt(first)], mesh.positions[mesh.vertexAt(first + 1)],
                      mesh.positions[mesh.vertexAt(first + 2)]);
}

}  // namespace

std::vector<SurfaceSample> sampleSurface(const WedgeMesh& mesh, std::size_t count) {
  std::vector<SurfaceSample> samples;
  std::vector<double> cumulative(mesh.triangles());
  double area = 0.0;
  for (std::uint32_t t = 0; t < cumulative.size(); ++t)
    cumulative[t] = area += areaOf(mesh, t);
  if (!(area > 0.0)) return samples;
  samples.reserve(count);
  std::uint32_t t = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double place = area * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    while (t + 1 < cumulative.size() && cumulative[t] <= place)
      ++t;
    const glm::dvec2 r = spread(k);
    const double root = std::sqrt(r.x);
    samples.push_back({t, glm::vec3(1.0 - root, root * (1.0 - r.y), root * r.y)});
  }
  return samples;
}

glm::vec3 positionAt(const WedgeMesh& mesh, std::uint32_t triangle, const glm::dvec3& barycentric) {
  glm::dvec3 point(0.0);
  for (int k = 0; k < 3; ++k)
    point += barycentric[k] *
             glm::dvec3(mesh.positions[mesh.vertexAt(3 * std::size_t{triangle} + static_cast<std::size_t>(k))]);
  return point;
}

glm::dvec3 shadingNormalAt(const WedgeMesh& mesh, const AttributeSlot* normals, std::uint32_t triangle,
                           const glm::dvec3& barycentric) {
  if (normals != nullptr) {
    glm::dvec3 sum(0.0);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t wedge = mesh.corners[3 * std::size_t{triangle} + static_cast<std::size_t>(k)];
      sum += barycentric[k] * glm::dvec3(mesh.vec3At(wedge, *normals));
    }
    const double length = glm::length(sum);
    if (length > 1e-6) return sum / length;
  }
  const std::size_t first = 3 * std::size_t{triangle};
  return faceNormal(mesh.positions[mesh.vertexAt(first)], mesh.positions[mesh.vertexAt(first + 1)],
                    mesh.positions[mesh.vertexAt(first + 2)]);
}

std::vector<std::uint32_t> triangleOfVertex(const WedgeMesh& mesh) {
  std::vector<std::uint32_t> result(mesh.positions.size(), ~0U);
  for (std::uint32_t c = 0; c < mesh.corners.size(); ++c)
    if (result[mesh.vertexAt(c)] == ~0U) result[mesh.vertexAt(c)] = c / 3;
  return result;
}

}  // namespace jalousie::bake
