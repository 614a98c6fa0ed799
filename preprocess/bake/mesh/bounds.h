// Bounding box of points.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "core/aabb.h"

namespace jalousie::bake {

/// The box of all points, in their frame; empty if there is none.
inline Aabb boundsOf(std::span<const glm::vec3> points) {
  Aabb box;
  for (const glm::vec3& p : points)
    box.add(p);
  return box;
}

}  // namespace jalousie::bake
