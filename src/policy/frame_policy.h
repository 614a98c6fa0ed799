// A frame's whole policy, and what follows from its parts together.
#pragma once

#include "policy/cull_mode.h"
#include "policy/detail.h"
#include "policy/lod_rule.h"
#include "policy/lv_measure.h"
#include "policy/view.h"

namespace jalousie {

/// One choice from each table. The defaults are the program's.
struct FramePolicy {
  CullMode cullMode = CullMode::kHiz;
  LodRule lodRule = LodRule::kPrice;
  LvMeasure lvMeasure = LvMeasure::kPixels;
  Detail detail = Detail::kDiscrete;
  View view = View::kShaded;
  bool calm = false;     ///< hysteresis, one level at a time and cross-fades, for rules that follow the error
  bool masking = false;  ///< errors count less behind small holes; see masksErrors()
};

/// gpu::CullView::traits of a policy: kTrait... of shared/traits.h.
gpu::uint traitsOf(const FramePolicy& policy);
/// The measure of LV where none is chosen: the rule's, or counted pixels where only the view shows LV.
LvMeasure defaultMeasure(const FramePolicy& policy);
/// Whether LV is computed: the level rule uses it or the view shows it.
bool wantsLv(const FramePolicy& policy);
/// Whether visible pixels are counted for LV.
bool countsPixels(const FramePolicy& policy);
/// Whether LV is computed from a block of the occlusion map or depth pyramid, which needs a mode that tests occlusion.
bool wantsBlock(const FramePolicy& policy);
/// Whether masking applies: the rule follows the error, the mode tests occlusion, and no measure of LV that is in use
/// contains the size of the holes already.
bool masksErrors(const FramePolicy& policy);
/// Whether a frame depends on the frames before it, so that a first frame differs from a settled one.
bool dependsOnHistory(const FramePolicy& policy);

}  // namespace jalousie
