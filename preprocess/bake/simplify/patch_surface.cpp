// Evaluates and tessellates the surface of a control mesh.
#include "bake/simplify/patch_surface.h"

#include <numeric>

#include "bake/mesh/normals.h"
#include "core/check.h"

namespace jalousie::bake {
namespace {

/// Points of the ring with `segments` segments per edge, of a pattern of `level`.
void addRing(std::uint32_t level, std::uint32_t segments, std::vector<glm::dvec3>& points) {
  if (segments == 0) {
    points.emplace_back(1.0 / 3.0);
    return;
  }
  const double least = static_cast<double>(level - segments) / (3.0 * level);
  for (int edge = 0; edge < 3; ++edge) {
    for (std::uint32_t i = 0; i < segments; ++i) {
      glm::dvec3 point(least);
      point[edge] += static_cast<double>(segments - i) / level;
      point[(edge + 1) % 3] += static_cast<double>(i) / level;
      points.push_back(point);
    }
  }
}

/// Triangles between a ring and the next one inside it. @param first  of the ring's points
void addBand(std::uint32_t first, std::uint32_t segments, std::vector<std::uint32_t>& indices) {
  const std::uint32_t inside = segments - 2;
  const auto outer = [&](std::uint32_t edge, std::uint32_t i) {
    return first + (edge * segments + i) % (3 * segments);
  };
  const auto inner = [&](std::uint32_t edge, std::uint32_t i) {
    return first + 3 * segments + (inside == 0 ? 0 : (edge * inside + i) % (3 * inside));
  };
  for (std::uint32_t edge = 0; edge < 3; ++edge) {
    indices.insert(indices.end(), {outer(edge, 0), outer(edge, 1), inner(edge, 0)});
    for (std::uint32_t i = 1; i < segments - 1; ++i) {
      indices.insert(indices.end(), {outer(edge, i), outer(edge, i + 1), inner(edge, i)});
      indices.insert(indices.end(), {outer(edge, i), inner(edge, i), inner(edge, i - 1)});
    }
    indices.insert(indices.end(), {outer(edge, segments - 1), outer(edge, segments), inner(edge, inside)});
  }
}

}  // namespace

PatchMesh patchesOf(const WedgeMesh& mesh) {
  PatchMesh patches;
  patches.positions = mesh.positions;
  patches.indices = vertexIndices(mesh);
  patches.normals = smoothNormals(patches.positions, patches.indices);
  return patches;
}

PatchPoint patchPoint(const PatchMesh& mesh, std::uint32_t triangle, const glm::dvec3& barycentric) {
  std::array<glm::dvec3, 3> x;
  std::array<glm::dvec3, 3> n;
  glm::dvec3 flat(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = mesh.indices[3 * std::size_t{triangle} + k];
    x[k] = mesh.positions[v];
    n[k] = mesh.normals[v];
    flat += barycentric[static_cast<int>(k)] * x[k];
  }
  PatchPoint result;
  glm::dmat3 common(1.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const double b = barycentric[static_cast<int>(k)];
    result.bend += b * glm::dot(flat - x[k], n[k]) * n[k];
    common -= mesh.alpha * b * glm::outerProduct(n[k], n[k]);
  }
  result.point = flat - mesh.alpha * result.bend;
  for (std::size_t k = 0; k < 3; ++k) {
    const double b = barycentric[static_cast<int>(k)];
    const glm::dvec3 d = flat - x[k];
    const glm::dmat3 plane = glm::outerProduct(n[k], n[k]);
    result.byPosition[k] = b * (common + mesh.alpha * plane);
    result.byNormal[k] = -mesh.alpha * b * (glm::outerProduct(n[k], d) + glm::dot(d, n[k]) * glm::dmat3(1.0)) *
                         (glm::dmat3(1.0) - plane);
  }
  return result;
}

PatchPattern patchPattern(std::uint32_t level) {
  JAL_CHECK(level > 0U);
  PatchPattern pattern;
  std::uint32_t segments = level;
  while (true) {
    const auto first = static_cast<std::uint32_t>(pattern.points.size());
    addRing(level, segments, pattern.points);
    if (segments == 1) pattern.indices.insert(pattern.indices.end(), {first, first + 1, first + 2});
    if (segments < 2) return pattern;
    addBand(first, segments, pattern.indices);
    segments -= 2;
  }
}

WedgeMesh tessellate(const PatchMesh& mesh, const PatchPattern& pattern) {
  WedgeMesh result;
  result.slots.push_back({.name = "NORMAL", .components = 3, .offset = 0, .kind = AttributeKind::kNormal});
  result.stride = 3;
  for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (const glm::dvec3& b : pattern.points) {
      glm::dvec3 normal(0.0);
      for (int k = 0; k < 3; ++k)
        normal += b[k] * glm::dvec3(mesh.normals[mesh.indices[3 * std::size_t{t} + static_cast<std::size_t>(k)]]);
      const double length = glm::length(normal);
      if (length > 0.0) normal /= length;
      result.positions.emplace_back(patchPoint(mesh, t, b).point);
      for (int k = 0; k < 3; ++k)
        result.attributes.push_back(static_cast<float>(normal[k]));
    }
    for (const std::uint32_t index : pattern.indices)
      result.corners.push_back(first + index);
  }
  result.vertexOf.resize(result.positions.size());
  std::iota(result.vertexOf.begin(), result.vertexOf.end(), 0U);
  result.primitiveOf.resize(result.positions.size(), 0);
  result.sourceWedge.resize(result.positions.size(), 0);
  return result;
}

}  // namespace jalousie::bake
