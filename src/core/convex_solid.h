// Convex solids and polygons: what hides everything behind it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/aabb.h"

namespace jalousie {

/// A convex polyhedron, or, with one face, a convex polygon.
struct ConvexSolid {
  static constexpr std::size_t kMostVertices = 32;
  static constexpr std::size_t kMostFaces = 32;

  std::vector<glm::vec3> vertices;
  /// Corners of each face, counter-clockwise as seen from outside, or from the front of a polygon.
  std::vector<std::vector<std::uint32_t>> faces;
  /// Of a polygon: whether it hides what is in front of it from behind as well.
  bool bothSides = false;

  bool isPolygon() const { return faces.size() == 1; }
  friend bool operator==(const ConvexSolid&, const ConvexSolid&) = default;
};

/// The solid of a box with an extent on all axes.
ConvexSolid solidOf(const Aabb& box);

/// Box of the vertices.
Aabb boundsOf(const ConvexSolid& solid);

/// Normal of a face, not unit: twice its area long. @param corners  indices of vertices, at least 3
glm::dvec3 faceNormal(const ConvexSolid& solid, const std::vector<std::uint32_t>& corners);

/// What keeps untrusted input from being a convex solid or polygon: numbers that are not finite, indices out of range,
/// a surface with gaps or in several parts, faces without area, a vertex before a face or beside its plane. Lengths
/// are off by at most a ten-thousandth of the size. nullopt: nothing.
std::optional<std::string> faultOf(const ConvexSolid& solid);

}  // namespace jalousie
