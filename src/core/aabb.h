// Axis-aligned bounding box.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace jalousie {

/// Closed box [min, max] in the frame its owner names. Default: empty (min > max).
struct Aabb {
  glm::vec3 min{std::numeric_limits<float>::infinity()};
  glm::vec3 max{-std::numeric_limits<float>::infinity()};

  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  glm::vec3 center() const { return 0.5F * (min + max); }
  glm::vec3 extent() const { return max - min; }
  float diagonal() const { return empty() ? 0.0F : glm::length(extent()); }
  void add(const glm::vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void add(const Aabb& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
};

/// Box of the eight transformed corners; exact for axis-aligned results, conservative otherwise.
inline Aabb transformed(const glm::mat4& targetFromSource, const Aabb& box) {
  Aabb result;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                      (corner & 4) != 0 ? box.max.z : box.min.z);
    result.add(glm::vec3(targetFromSource * glm::vec4(p, 1.0F)));
  }
  return result;
}

}  // namespace jalousie
