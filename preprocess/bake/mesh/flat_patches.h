// Flat faces of a mesh, whatever triangles they are made of.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace jalousie::bake {

/// Connected triangles of one plane, as polygons. Bounds the distance from a triangle to a flat face without looking at
/// the triangles of the face: on flat surfaces, the nearest triangles of a point tell little of its neighbourhood.
class FlatPatches {
 public:
  /// A patch with more sides is not kept: each bound looks at all of them.
  static constexpr std::size_t kMostSides = 96;

  /// @param indices  in threes, in range   @param rounding  how far a vertex may lie off a plane, object-space length
  FlatPatches(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, double rounding);

  /// At least the largest distance from a point of a piece to the patch that a triangle belongs to, object-space
  /// length. Infinite if the piece does not lie over that patch, or if the triangle belongs to none.
  /// @param piece  corners of a triangle
  double bound(std::uint32_t triangle, const std::array<glm::vec3, 3>& piece) const;
  /// Patches of two and more triangles.
  std::size_t size() const { return patches_.size(); }

 private:
  struct Side {
    glm::dvec2 a, b;
  };
  struct Patch {
    glm::dvec3 origin;
    glm::dvec3 u, v, normal;  ///< unit length
    std::size_t firstSide = 0;
    std::size_t sideCount = 0;
  };
  class Builder;
  static constexpr std::uint32_t kNone = ~0U;
  bool holds(const Patch& patch, const glm::dvec2& point) const;

  double rounding_;
  std::vector<std::uint32_t> patchOf_;  ///< of each triangle
  std::vector<Patch> patches_;
  std::vector<Side> sides_;
};

}  // namespace jalousie::bake
