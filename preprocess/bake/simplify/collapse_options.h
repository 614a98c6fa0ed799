// Options of the edge collapse.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace jalousie::bake {

/// No level has fewer triangles.
inline constexpr std::uint32_t kMinLevelTriangles = 4;

/// How much a deviation of an attribute counts beside a geometric one. Weights are without unit; 0 leaves an attribute
/// out of the error (its values are still interpolated). The defaults gave the smallest measured errors.
struct CollapseOptions {
  std::optional<double> normalWeight;  ///< 1 if absent, 0 in the preset `fast`
  double uvWeight = 1.0;
  double colorWeight = 1.0;
  bool lockBorder = false;                   ///< vertices of open borders keep position and attributes
  std::vector<std::uint8_t> lockedVertices;  ///< for each vertex 1 if it keeps position and attributes; empty: none
};

}  // namespace jalousie::bake
