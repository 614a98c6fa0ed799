// Plain CPU twin of the occlusion map: the pyramid of open pixels (thesis 3.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/map_layout.h"

namespace jalousie::visibility {

/// The pyramid. Level L holds, per texel, the number of open pixels: exact sums, so no open pixel is lost to rounding.
/// Row 0 is the bottom row, as in window coordinates.
class OcclusionMapReference {
 public:
  /// @param openPixels  [screenWidth * screenHeight], 1 where no occluder covers the pixel, else 0; row 0 at the bottom
  OcclusionMapReference(const MapLayout& layout, std::span<const float> openPixels);

  const MapLayout& layout() const { return layout_; }
  std::span<const float> level(std::uint32_t level) const { return levels_[level]; }
  /// Number of screen pixels a texel stands for; 0 for padding.
  std::uint32_t texelArea(std::uint32_t x, std::uint32_t y, std::uint32_t level) const;
  /// Covered share of the texel's pixels, in [0, 1]: exactly 1 only if every pixel is covered. @pre the texel has area
  float opacity(std::uint32_t x, std::uint32_t y, std::uint32_t level) const;

 private:
  MapLayout layout_;
  std::vector<std::vector<float>> levels_;
};

}  // namespace jalousie::visibility
