// The debug views, in one table.
#pragma once

#include <span>

#include "shared/frame_structs.h"

namespace jalousie {

/// What the picture shows. Shaders know a view by the same value (kView... of shared/frame_structs.h).
enum class View : gpu::uint {
  kShaded = gpu::kViewShaded,
  kLod = gpu::kViewLod,
  kLv = gpu::kViewLv,
  kOcclusion = gpu::kViewOcclusion,
  kPhase = gpu::kViewPhase,
  kCoverage = gpu::kViewCoverage,
  kHoles = gpu::kViewHoles,
  kWireframe = gpu::kViewWireframe,
  kOverdraw = gpu::kViewOverdraw,
  kGhosts = gpu::kViewGhosts,
  kLevels = gpu::kViewLevels,
  kDensity = gpu::kViewDensity,
};

/// One row of the table.
struct ViewRow {
  const char* name;  ///< value of --view
  View id;
  bool needsOcclusionTest = false;  ///< shows a result of the occlusion test
  bool needsTwoPhases = false;      ///< shows the phase in which an object was drawn
  bool showsLv = false;             ///< LV is measured even where the level rule does not use it
  bool measuresCover = false;       ///< analyse.comp fills ScreenBox.cover
  bool replacesFrame = false;       ///< shows the occlusion map or depth pyramid instead of the objects
  bool addsPass = false;            ///< draws over, or instead of, the finished frame
  const char* help;                 ///< phrase for --help, panel and docs
};

/// All views, in the order of View.
std::span<const ViewRow> viewTable();
const ViewRow& rowOf(View view);

}  // namespace jalousie
