// Plain CPU twin of shaders/visibility/analyse.comp: overlap test and frequency analysis (thesis 3.4, 3.5).
#pragma once

#include <cstdint>

#include "shared/frame_structs.h"
#include "visibility/level_of_visibility.h"
#include "visibility/occlusion_map_reference.h"

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

/// Pixels that a clipped rectangle touches; never empty.
TexelRange touchedPixels(const gpu::ScreenRect& rect, std::uint32_t width, std::uint32_t height);

/// First texel and count (at most 16) of the analysed block along one dimension.
struct BlockSpan {
  std::uint32_t first, count;
};
/// A span that touches 17 texels loses the end that [lower, upper] (pixels) covers less.
BlockSpan blockSpan(std::uint32_t firstPixel, std::uint32_t lastPixel, float lower, float upper, std::uint32_t level);

/// The block four levels below LOM that the analysis looks at.
struct AnalysedBlock {
  std::uint32_t level = 0;
  BlockSpan x{}, y{};
  std::vector<float> opacity;  ///< [y.count * x.count], row by row
};
AnalysedBlock analysedBlock(const OcclusionMapReference& map, const gpu::ScreenRect& rect);

/// Verdict and LV of one occludee. @param cullThreshold  opacity from which a texel hides, (0, 1]
struct OverlapResult {
  gpu::uint verdict = gpu::kVerdictOpen;  ///< kVerdictOccluded, kVerdictOpen or kVerdictPartial
  float lv = -1.0F;                       ///< normalised
};
OverlapResult testOverlap(const OcclusionMapReference& map, const gpu::ScreenRect& rect, float cullThreshold);

}  // namespace jalousie::visibility
