// Which texels of a pyramid a rectangle on the screen touches (thesis 3.4, Eq. 3.1). GPU twin: shaders/lib/overlap.glsl
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace jalousie::visibility {

/// Level at which an extent is at most one texel: ceil(log2(extentPixels)), 0 below one pixel (Eq. 3.1).
std::uint32_t levelForExtent(float extentPixels);

/// Inclusive range of pixels or texels.
struct TexelRange {
  std::uint32_t firstX, firstY, lastX, lastY;
  TexelRange atLevel(std::uint32_t level) const {
    return {firstX >> level, firstY >> level, lastX >> level, lastY >> level};
  }
};

/// Pixels that a clipped rectangle (min.xy, max.xy) touches; never empty.
TexelRange touchedPixels(const glm::vec4& rect, std::uint32_t width, std::uint32_t height);

/// First texel and count (at most kMaxBlockSide) of the analysed block along one dimension.
struct BlockSpan {
  std::uint32_t first, count;
};
/// Texels that [firstPixel, lastPixel] touches. Of 17 texels, the end that [lower, upper] (pixels) covers less is left
/// out.
BlockSpan blockSpan(std::uint32_t firstPixel, std::uint32_t lastPixel, float lower, float upper, std::uint32_t level);

}  // namespace jalousie::visibility
