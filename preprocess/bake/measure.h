// How far a level lies from the original surface, measured.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bake/triangle_bvh.h"

namespace jalousie::bake {

/// Triangles to measure: positions with indices in threes.
struct Surface {
  std::span<const glm::vec3> positions;
  std::span<const std::uint32_t> indices;
};

/// Points all over a surface: every vertex in use, and `count` more spread evenly by area (a low-discrepancy sequence,
/// the same for the same surface).
std::vector<glm::vec3> samplePoints(const Surface& surface, std::uint32_t count);

/// Distances in object-space length, both ways: points of the level to the original and points of the original to the
/// level.
struct Deviation {
  double max = 0.0;
  double mean = 0.0;  ///< of the larger of the two one-sided means
};

/// Measures levels against one original, whose hierarchy and samples are made once.
class DeviationMeter {
 public:
  DeviationMeter(const Surface& original, std::uint32_t samples);
  /// Uses all cores; the result does not depend on how many there are.
  Deviation measure(const Surface& level) const;

 private:
  TriangleBvh original_;
  std::vector<glm::vec3> originalPoints_;
  std::uint32_t samples_;
};

}  // namespace jalousie::bake
