// Plain CPU twin of shaders/visibility/analyse.comp: overlap test and frequency analysis (thesis 3.4, 3.5).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scene/scene_data.h"
#include "shared/frame_structs.h"
#include "shared/scene_structs.h"
#include "visibility/depth_pyramid_reference.h"
#include "visibility/hiddenness.h"
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

/// Pixels that a clipped rectangle (min.xy, max.xy) touches; never empty.
TexelRange touchedPixels(const glm::vec4& rect, std::uint32_t width, std::uint32_t height);

/// First texel and count (at most 16) of the analysed block along one dimension.
struct BlockSpan {
  std::uint32_t first, count;
};
/// A span that touches 17 texels loses the end that [lower, upper] (pixels) covers less.
BlockSpan blockSpan(std::uint32_t firstPixel, std::uint32_t lastPixel, float lower, float upper, std::uint32_t level);

/// What hides: an occlusion map (hom), a depth pyramid (hiz), or the map where its depths lie in front (hom-depth).
/// Borrows both.
struct Cover {
  const OcclusionMapReference* map = nullptr;
  const DepthPyramidReference* pyramid = nullptr;

  const MapLayout& layout() const { return map != nullptr ? map->layout() : pyramid->layout(); }
  bool depthAware() const { return pyramid != nullptr; }
  /// Covered share of a texel's pixels as an object at a depth sees it, in [0, 1].
  float opacity(std::uint32_t x, std::uint32_t y, std::uint32_t level, float nearestDepth) const;
};

/// The block four levels below LOM that the analysis looks at.
struct AnalysedBlock {
  std::uint32_t level = 0;
  BlockSpan x{}, y{};
  std::vector<float> opacity;  ///< [y.count * x.count], row by row
};
AnalysedBlock analysedBlock(const Cover& cover, const gpu::ScreenBox& box);

/// Verdict and LV of one occludee. @param cullThreshold  opacity from which a texel hides, (0, 1]
/// @param lvTraits  kTraitLv... as for blockLv; absent: no block is looked at, and LV has no meaning
/// @param guardPixels  the rectangle grows by this much on every side: the occluders' own error (hom-depth)
struct OverlapResult {
  gpu::uint verdict = gpu::kVerdictOpen;  ///< kVerdictOccluded, kVerdictOpen or kVerdictPartial
  float lv = -1.0F;                       ///< normalised
};
OverlapResult testOverlap(const Cover& cover, const gpu::ScreenBox& box, float cullThreshold, float guardPixels = 0.0F,
                          std::optional<gpu::uint> lvTraits = gpu::kTraitLvThesis);

/// What the kernel makes of a pending object (with kMarkCounted, its LV stays as it is): verdict, lv, phase, and where
/// the rule follows LV the detail of what is drawn late. @pre state.verdict is kVerdictPending; view.analyse is 1
void applyOverlap(const OverlapResult& result, const scene::SceneData& scene, const gpu::CullView& view,
                  const gpu::Chain& chain, const gpu::ScreenBox& box, gpu::ObjectState& state, gpu::uint& marks);

}  // namespace jalousie::visibility
