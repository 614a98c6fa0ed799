// Plain CPU twin of shaders/visibility/analyse.comp: overlap test and frequency analysis (thesis 3.4, 3.5).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "shared/frame_structs.h"
#include "shared/scene_structs.h"
#include "visibility/depth_pyramid_reference.h"
#include "visibility/hiddenness.h"
#include "visibility/level_of_visibility.h"
#include "visibility/object_decision.h"
#include "visibility/occlusion_map_reference.h"
#include "visibility/pyramid_addressing.h"

namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::visibility {

/// What the overlap test looks at: an occlusion map, a depth pyramid, or both: then the map counts where its occluders
/// lie in front of the object. Borrows both.
struct Cover {
  const OcclusionMapReference* map = nullptr;
  const DepthPyramidReference* pyramid = nullptr;

  const MapLayout& layout() const { return map != nullptr ? map->layout() : pyramid->layout(); }
  bool depthAware() const { return pyramid != nullptr; }
  /// Covered share of a texel's pixels, in [0, 1], for an object at a depth.
  float opacity(std::uint32_t x, std::uint32_t y, std::uint32_t level, float nearestDepth) const;
};

/// The block of texels kBlockLevels below LOM that the measures of visibility look at.
struct AnalysedBlock {
  std::uint32_t level = 0;
  BlockSpan x{}, y{};
  std::vector<float> opacity;  ///< [y.count * x.count], row by row
};
AnalysedBlock analysedBlock(const Cover& cover, const gpu::ScreenBox& box);

/// A bounding rectangle that grows by so many pixels on every side, clipped to the screen of the layout.
gpu::ScreenBox grown(gpu::ScreenBox box, const MapLayout& layout, float guardPixels);

/// gpu::ScreenBox::cover of an object, as the kernel measures it.
/// @param guardPixels  as for testOverlap
gpu::uint measuredCover(const Cover& cover, const gpu::ScreenBox& box, float guardPixels = 0.0F);

/// Verdict and LV of one object.
struct OverlapResult {
  gpu::uint verdict = gpu::kVerdictOpen;  ///< kVerdictOccluded, kVerdictOpen or kVerdictPartial
  float lv = -1.0F;                       ///< normalised
};
/// @param cullThreshold  opacity from which a texel occludes, (0, 1]
/// @param guardPixels    the rectangle grows by this much on every side, for the error of the occluders
/// @param lvTraits       kTraitLv... as for blockLv; absent: no block is looked at, and LV has no meaning
OverlapResult testOverlap(const Cover& cover, const gpu::ScreenBox& box, float cullThreshold, float guardPixels = 0.0F,
                          std::optional<gpu::uint> lvTraits = gpu::kTraitLvThesis);

/// What the result changes in a pending object: verdict, LV (not with kMarkCounted), phase, and where the level rule
/// follows LV or masks errors the detail of an object that is drawn late and has no count.
/// @pre object.state.verdict is kVerdictPending; view.analyse is 1; with kTraitMasksError object.box.cover is measured
void applyOverlap(const OverlapResult& result, const scene::SceneData& scene, const gpu::CullView& view,
                  const gpu::Chain& chain, ObjectDecision& object);

}  // namespace jalousie::visibility
