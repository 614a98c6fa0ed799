// Each question about several tables has its answer here.
#include "policy/frame_policy.h"

namespace jalousie {

gpu::uint traitsOf(const FramePolicy& policy) {
  return traitsOf(policy.cullMode) | traitsOf(policy.lodRule) | traitsOf(policy.lvMeasure) | traitsOf(policy.detail) |
         (masksErrors(policy) ? gpu::kTraitMasksError : 0);
}

LvMeasure defaultMeasure(const FramePolicy& policy) {
  const LodRuleRow& rule = rowOf(policy.lodRule);
  return !rule.followsLv && rowOf(policy.view).showsLv ? LvMeasure::kPixels : rule.measure;
}

bool wantsLv(const FramePolicy& policy) {
  return rowOf(policy.lodRule).followsLv || rowOf(policy.view).showsLv;
}

bool countsPixels(const FramePolicy& policy) {
  return wantsLv(policy) && rowOf(policy.lvMeasure).countsPixels;
}

bool wantsBlock(const FramePolicy& policy) {
  return wantsLv(policy) && !rowOf(policy.lvMeasure).countsPixels;
}

bool masksErrors(const FramePolicy& policy) {
  const LodRuleRow& rule = rowOf(policy.lodRule);
  const bool twice = rule.followsLv && rowOf(policy.lvMeasure).measuresHoles;
  return policy.masking && rule.followsError && rowOf(policy.cullMode).testsOcclusion && !twice;
}

bool dependsOnHistory(const FramePolicy& policy) {
  const bool calm = policy.calm && rowOf(policy.lodRule).followsError;
  return rowOf(policy.cullMode).needsHistory || countsPixels(policy) || calm;
}

}  // namespace jalousie
