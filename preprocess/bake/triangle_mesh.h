// The indexed triangle mesh that PLY and OBJ files become, and its normals.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace jalousie::bake {

/// Object-space triangles. Attribute vectors have positions.size() elements or none; indices come in threes, in range.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec4> colors;  ///< linear RGBA
  std::vector<std::uint32_t> indices;
};

/// For each position, the lowest index that holds the same one (-0 equals 0). O(n log n), deterministic.
std::vector<std::uint32_t> weldByPosition(std::span<const glm::vec3> positions);

/// Smooth unit normals: face normals weighted by corner angle, summed per position. +y where there is no area.
std::vector<glm::vec3> smoothNormals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

/// Unit normal of a triangle, zero if it has no area.
glm::dvec3 faceNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace jalousie::bake
