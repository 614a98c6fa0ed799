// One row per level rule.
#include "policy/lod_rule.h"

#include "policy/table.h"

namespace jalousie {
namespace {

constexpr LodRuleRow kRules[] = {
    {.name = "finest", .id = LodRule::kFinest, .help = "always LOD 0"},
    {.name = "linear",
     .id = LodRule::kLinear,
     .followsLv = true,
     .measure = LvMeasure::kThesis,
     .help = "LV mapped linearly onto the levels, as in the thesis"},
    {.name = "pixel-error",
     .id = LodRule::kPixelError,
     .followsError = true,
     .help = "coarsest level whose screen-space error is at most --tau"},
    {.name = "coverage",
     .id = LodRule::kCoverage,
     .followsError = true,
     .followsCoverage = true,
     .help = "finest level whose MSFT_screencoverage the bounding sphere covers, as if it were --tau times smaller"},
    {.name = "lv-error",
     .id = LodRule::kLvError,
     .followsError = true,
     .followsLv = true,
     .measure = LvMeasure::kPixels,
     .help = "pixel-error with a larger --tau for partly occluded objects"},
    {.name = "price",
     .id = LodRule::kPrice,
     .followsError = true,
     .followsLv = true,
     .pricesTriangles = true,
     .measure = LvMeasure::kPixels,
     .help = "least sum of visible pixels times mean error and of triangles times one price, which grows with --tau"},
};
static_assert(policy::isInOrder(kRules));

}  // namespace

std::span<const LodRuleRow> lodRuleTable() {
  return kRules;
}

const LodRuleRow& rowOf(LodRule rule) {
  return policy::row(lodRuleTable(), rule);
}

bool relaxesTau(const LodRuleRow& rule) {
  return rule.followsError && rule.followsLv && !rule.pricesTriangles;
}

bool usesErrors(const LodRuleRow& rule) {
  return rule.followsError && !rule.followsCoverage;
}

gpu::uint traitsOf(LodRule rule) {
  const LodRuleRow& row = rowOf(rule);
  return (row.followsError ? gpu::kTraitFollowsError : 0) | (row.followsLv ? gpu::kTraitFollowsLv : 0) |
         (row.pricesTriangles ? gpu::kTraitPrice : 0) | (row.followsCoverage ? gpu::kTraitCoverage : 0);
}

}  // namespace jalousie
