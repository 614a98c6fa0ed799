// Sizes of the pyramids over the screen: occlusion map and depth pyramid.
#pragma once

#include <cstdint>

namespace jalousie::visibility {

/// Size of a pyramid: the screen padded to powers of two, so that texel (x, y) of level L stands for exactly the pixels
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

}  // namespace jalousie::visibility
