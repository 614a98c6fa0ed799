// Places by their coordinates, and the separating axes of a triangle and a box.
#include "bake/mesh/level_surface.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace jalousie::bake {

std::vector<std::uint32_t> firstAtPlace(const LevelSurface& surface) {
  using Place = std::tuple<float, float, float>;
  std::map<Place, std::uint32_t> numbers;
  std::vector<std::uint32_t> first(surface.positions.size());
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    const glm::vec3 p = surface.positions[i] + 0.0F;  // -0 is 0
    first[i] = numbers.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(i)).first->second;
  }
  return first;
}

bool touches(const glm::dvec3 (&triangle)[3], const glm::dvec3& center, const glm::dvec3& half) {
  const glm::dvec3 v[3] = {triangle[0] - center, triangle[1] - center, triangle[2] - center};
  const double size = std::max({glm::length(v[0]), glm::length(v[1]), glm::length(v[2]), glm::length(half)});
  const auto isApart = [&](const glm::dvec3& axis) {
    const double reach = glm::dot(glm::abs(axis), half) + 1e-12 * size * glm::length(axis);
    const double a = glm::dot(axis, v[0]);
    const double b = glm::dot(axis, v[1]);
    const double c = glm::dot(axis, v[2]);
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  const glm::dvec3 edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 side(0.0);
    side[axis] = 1.0;
    if (isApart(side)) return false;
    for (const glm::dvec3& edge : edges)
      if (isApart(glm::cross(side, edge))) return false;
  }
  return !isApart(glm::cross(edges[0], edges[1]));
}

}  // namespace jalousie::bake
