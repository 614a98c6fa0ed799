// Checks a solid edge by edge, then face by face.
#include "core/convex_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace jalousie {
namespace {

constexpr double kTolerance = 1e-4;  ///< of the diagonal

using Corners = std::vector<std::uint32_t>;

glm::dvec3 vertexOf(const ConvexSolid& solid, std::uint32_t index) {
  return solid.vertices[index];
}

std::optional<std::string> faultOfCounts(const ConvexSolid& solid) {
  if (solid.vertices.size() < 3 || solid.vertices.size() > ConvexSolid::kMostVertices)
    return "has not 3 to 32 vertices";
  if (solid.faces.empty() || solid.faces.size() > ConvexSolid::kMostFaces) return "has not 1 to 32 faces";
  for (const glm::vec3& v : solid.vertices)
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return "has a vertex that is not finite";
  std::set<std::uint32_t> used;
  for (const Corners& face : solid.faces) {
    const std::set<std::uint32_t> corners(face.begin(), face.end());
    if (face.size() < 3 || corners.size() != face.size()) return "has a face without three different corners";
    if (*corners.rbegin() >= solid.vertices.size()) return "has a face with a vertex that does not exist";
    used.insert(corners.begin(), corners.end());
  }
  if (used.size() != solid.vertices.size()) return "has a vertex without a face";
  return std::nullopt;
}

/// A closed surface has each edge once in each direction; a single one that is a sphere has V - E + F = 2.
std::optional<std::string> faultOfSurface(const ConvexSolid& solid) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Corners& face : solid.faces)
    for (std::size_t i = 0; i < face.size(); ++i)
      if (!edges.insert({face[i], face[(i + 1) % face.size()]}).second) return "has an edge twice in one direction";
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from})) return "is not closed";
  if (solid.vertices.size() + solid.faces.size() != edges.size() / 2 + 2) return "is not one solid";
  return std::nullopt;
}

/// Corners turn left everywhere, and once around.
bool isConvexFace(const ConvexSolid& solid, const Corners& face, const glm::dvec3& normal, double slack) {
  for (std::size_t i = 0; i < face.size(); ++i) {
    const glm::dvec3 a = vertexOf(solid, face[i]);
    const glm::dvec3 edge = vertexOf(solid, face[(i + 1) % face.size()]) - a;
    const double length = glm::length(edge);
    if (!(length > slack)) return false;
    const glm::dvec3 inward = glm::cross(normal, edge / length);
    for (const std::uint32_t other : face)
      if (glm::dot(inward, vertexOf(solid, other) - a) < -slack) return false;
  }
  return true;
}

std::optional<std::string> faultOfFace(const ConvexSolid& solid, const Corners& face, double slack) {
  const glm::dvec3 normal = faceNormal(solid, face);
  const double doubleArea = glm::length(normal);
  if (!(doubleArea > slack * slack)) return "has a face without area";
  const glm::dvec3 unit = normal / doubleArea;
  const glm::dvec3 on = vertexOf(solid, face[0]);
  for (const std::uint32_t corner : face)
    if (std::abs(glm::dot(unit, vertexOf(solid, corner) - on)) > slack) return "has a face that is not flat";
  for (const glm::vec3& v : solid.vertices)
    if (glm::dot(unit, glm::dvec3(v) - on) > slack) return "is not convex";
  if (!isConvexFace(solid, face, unit, slack)) return "has a face that is not convex";
  return std::nullopt;
}

}  // namespace

ConvexSolid solidOf(const Aabb& box) {
  ConvexSolid solid;
  for (int corner = 0; corner < 8; ++corner)
    solid.vertices.emplace_back((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                                (corner & 4) != 0 ? box.max.z : box.min.z);
  solid.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return solid;
}

Aabb boundsOf(const ConvexSolid& solid) {
  Aabb box;
  for (const glm::vec3& v : solid.vertices)
    box.add(v);
  return box;
}

glm::dvec3 faceNormal(const ConvexSolid& solid, const std::vector<std::uint32_t>& corners) {
  const glm::dvec3 first = vertexOf(solid, corners[0]);
  glm::dvec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += glm::cross(vertexOf(solid, corners[i]) - first, vertexOf(solid, corners[i + 1]) - first);
  return normal;
}

std::optional<std::string> faultOf(const ConvexSolid& solid) {
  if (std::optional<std::string> fault = faultOfCounts(solid)) return fault;
  if (!solid.isPolygon())
    if (std::optional<std::string> fault = faultOfSurface(solid)) return fault;
  const Aabb box = boundsOf(solid);
  const double diagonal = glm::length(glm::dvec3(box.max) - glm::dvec3(box.min));
  for (const Corners& face : solid.faces)
    if (std::optional<std::string> fault = faultOfFace(solid, face, kTolerance * diagonal)) return fault;
  return std::nullopt;
}

}  // namespace jalousie
