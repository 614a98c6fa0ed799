// The base mesh of the tessellation path: normals averaged per position, and a box that holds the curved surface.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/aabb.h"

namespace jalousie::scene {

/// Blend towards the projected surface; 3/4 in Boubekeur and Alexa 2008.
inline constexpr float kPhongAlpha = 0.75F;

/// One normal per vertex, the same for all vertices at one position: face normals weighted by the corner's angle.
/// Equal normals on both sides of every edge are what keeps the tessellated surface closed (thesis 4.1.3).
/// @param positions  object space   @param indices  three per triangle, in range
/// @return           [positions.size()] unit vectors; +y where a position has no triangle with area
std::vector<glm::vec3> averagedNormals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

/// Point of the Phong-tessellated triangle. @param barycentric  sum 1   GPU twin: shaders/lib/phong.glsl
glm::vec3 phongPoint(const glm::vec3& barycentric, std::span<const glm::vec3, 3> corners,
                     std::span<const glm::vec3, 3> normals, float alpha);

/// Box of the whole tessellated surface. The surface is quadratic in the barycentric coordinates, so the hull of its
/// six Bezier control points bounds it: the corners, and per edge (1-a)(pi+pj)/2 + a (proj_i(pj) + proj_j(pi))/2.
Aabb phongBounds(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                 std::span<const std::uint32_t> indices, float alpha);

/// Upper bound of the distance between the flat triangles and the curved surface, object units: 2/3 of the largest
/// offset of an edge's control point. At tessellation level n it falls to 1/n^2 of this.
float phongError(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                 std::span<const std::uint32_t> indices, float alpha);

/// Triangles that one triangle becomes at an equal-spaced level: rings of 6 (n - 1), 6 (n - 3), ... around the middle.
/// n = 1: 1, n = 2: 6, n = 20: 600.
std::uint32_t tessellatedTriangles(std::uint32_t level);

}  // namespace jalousie::scene
