// Plain CPU twin of the occlusion map: the pyramid of open pixels (thesis 3.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace jalousie::visibility {

/// Size of a map: the screen padded to powers of two, so that texel (x, y) of level L stands for exactly the pixels
/// [x << L, (x + 1) << L) x [y << L, (y + 1) << L) that lie on the screen.
struct MapLayout {
  std::uint32_t screenWidth = 0;  ///< pixels
  std::uint32_t screenHeight = 0;
  std::uint32_t width = 1;  ///< texels of level 0
  std::uint32_t height = 1;
  std::uint32_t levels = 1;  ///< down to 1x1

  std::uint32_t levelWidth(std::uint32_t level) const { return width >> level > 0 ? width >> level : 1; }
  std::uint32_t levelHeight(std::uint32_t level) const { return height >> level > 0 ? height >> level : 1; }
};

/// Layout for a screen. @pre both sides in [1, 16384] (checked)
MapLayout mapLayout(std::uint32_t screenWidth, std::uint32_t screenHeight);

/// The pyramid. Level L holds, per texel, the number of open pixels: exact sums, so nothing is ever rounded away.
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
