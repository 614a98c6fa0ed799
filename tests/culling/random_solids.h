// Convex solids at random, and what they hide by the definition: a line of sight that meets the solid.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/convex_solid.h"
#include "core/random.h"

namespace jalousie::culling {

inline glm::vec3 randomVector(Random& random, float reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

inline glm::dmat4 randomTransform(Random& random) {
  glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(randomVector(random, 3.0F)));
  const glm::vec3 axis = randomVector(random, 1.0F) + glm::vec3(0.0F, 1.5F, 0.0F);
  matrix = glm::rotate(matrix, double{random.uniform(-3.0F, 3.0F)}, glm::dvec3(glm::normalize(axis)));
  const double mirror = random.below(3) == 0 ? -1.0 : 1.0;
  return glm::scale(matrix, glm::dvec3(mirror * double{random.uniform(0.3F, 2.0F)}, double{random.uniform(0.3F, 2.0F)},
                                       double{random.uniform(0.3F, 2.0F)}));
}

/// A prism over a regular polygon, cut off obliquely at the top.
inline ConvexSolid prism(std::uint32_t corners) {
  ConvexSolid solid;
  std::vector<std::uint32_t> bottom;
  std::vector<std::uint32_t> top;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(corners);
    const glm::vec2 at(std::cos(angle), std::sin(angle));
    solid.vertices.emplace_back(at.x, -1.0F, at.y);
    solid.vertices.emplace_back(at.x, 1.0F + 0.4F * at.x, at.y);
    bottom.push_back(2 * i);
    top.insert(top.begin(), 2 * i + 1);
    const std::uint32_t next = 2 * ((i + 1) % corners);
    solid.faces.push_back({2 * i, 2 * i + 1, next + 1, next});
  }
  solid.faces.push_back(bottom);
  solid.faces.push_back(top);
  return solid;
}

inline ConvexSolid randomSolid(Random& random) {
  return random.below(2) == 0 ? solidOf({glm::vec3(-1.0F), glm::vec3(1.0F)}) : prism(3 + random.below(5));
}

/// A regular polygon in the plane z = 0, facing +z.
inline ConvexSolid polygon(std::uint32_t corners, bool bothSides) {
  ConvexSolid solid;
  solid.bothSides = bothSides;
  solid.faces.emplace_back();
  for (std::uint32_t i = 0; i < corners; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(corners);
    solid.vertices.emplace_back(std::cos(angle), std::sin(angle), 0.0F);
    solid.faces[0].push_back(i);
  }
  return solid;
}

/// Whether the line of sight from a point to the eye meets the solid, by cutting it with all faces. A line that meets a
/// polygon is cut with its plane alone: the polygon's edges are walls along its normal.
/// @param slack  by which the solid is larger, object space
inline bool meets(const ConvexSolid& solid, const glm::dvec3& eye, const glm::dvec3& point, double slack) {
  constexpr double kThin = 1e-9;  // half the thickness of a polygon
  double first = 0.0;
  double last = 1.0;
  const auto cut = [&](const glm::dvec3& normal, double offset, double wider) {
    const double atEye = glm::dot(normal, eye) - offset - wider;
    const double atPoint = glm::dot(normal, point) - offset - wider;
    if (atEye > 0.0 && atPoint > 0.0) last = -1.0;
    if (atEye > 0.0 && atPoint <= 0.0) first = std::max(first, atEye / (atEye - atPoint));
    if (atEye <= 0.0 && atPoint > 0.0) last = std::min(last, atEye / (atEye - atPoint));
  };
  for (const std::vector<std::uint32_t>& face : solid.faces) {
    const glm::dvec3 normal = glm::normalize(faceNormal(solid, face));
    const glm::dvec3 on(solid.vertices[face[0]]);
    cut(normal, glm::dot(normal, on), solid.isPolygon() ? kThin : slack);
    if (!solid.isPolygon()) continue;
    cut(-normal, -glm::dot(normal, on), kThin);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const glm::dvec3 from(solid.vertices[face[i]]);
      const glm::dvec3 edge = glm::dvec3(solid.vertices[face[(i + 1) % face.size()]]) - from;
      const glm::dvec3 outward = glm::normalize(glm::cross(edge, normal));
      cut(outward, glm::dot(outward, from), slack);
    }
  }
  return first <= last;
}

}  // namespace jalousie::culling
