// The measures of how occluded an object is, in one table (docs/level_of_visibility.md).
#pragma once

#include <cstddef>
#include <span>

#include "shared/traits.h"

namespace jalousie {

/// Measures h in [0, 1]; an object's LV is 2 h - 1, except that the thesis' own may lie below -1.
/// Values index lvMeasureTable().
enum class LvMeasure : gpu::uint { kNone, kThesis, kSpectral, kChord, kCoverage, kPixels };

inline constexpr std::size_t kLvMeasureCount = 6;

/// One row of the table.
struct LvMeasureRow {
  const char* name;  ///< value of --lv
  LvMeasure id;
  gpu::uint trait = 0;  ///< kTraitLv... of shared/traits.h; 0 for none
  /// Counted in past frames: needs history. Other measures read a block of the occlusion map or depth pyramid: they
  /// need a mode that tests occlusion.
  bool countsPixels = false;
  bool measuresHoles = false;  ///< contains the size of the holes, so that masking would apply it twice
  const char* help;            ///< phrase for --help, panel and docs
};

/// All measures, in the order of LvMeasure.
std::span<const LvMeasureRow> lvMeasureTable();
const LvMeasureRow& rowOf(LvMeasure measure);
/// kTrait... of shared/traits.h.
gpu::uint traitsOf(LvMeasure measure);

}  // namespace jalousie
