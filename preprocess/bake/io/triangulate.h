// Divides polygons into triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace jalousie::bake {

/// The n - 2 triangles of a polygon as indices of its corners, by ear clipping in the plane of its mean normal. A
/// convex polygon becomes a fan around its first corner.
std::vector<std::uint32_t> triangulate(std::span<const glm::dvec3> polygon);

}  // namespace jalousie::bake
