// Face normals, areas and smooth vertex normals of indexed triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace jalousie::bake {

/// Unit normal of triangle abc; zero if the triangle has no area.
glm::dvec3 faceNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Area of triangle abc.
double triangleArea(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Smooth unit normals: face normals weighted by corner angle, summed per position. +y where the sum vanishes.
/// @return  one normal per position
std::vector<glm::vec3> smoothNormals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace jalousie::bake
