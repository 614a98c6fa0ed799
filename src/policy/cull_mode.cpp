// One row per culling mode.
#include "policy/cull_mode.h"

#include "policy/table.h"

namespace jalousie {
namespace {

constexpr CullModeRow kModes[] = {
    {.name = "full", .id = CullMode::kFull, .conservative = true, .help = "no culling"},
    {.name = "frustum", .id = CullMode::kFrustum, .culls = true, .conservative = true, .help = "frustum culling"},
    {.name = "hom",
     .id = CullMode::kHom,
     .culls = true,
     .testsOcclusion = true,
     .usesMap = true,
     .help = "hierarchical occlusion map without depth, as in the thesis"},
    {.name = "hom-depth",
     .id = CullMode::kHomDepth,
     .culls = true,
     .testsOcclusion = true,
     .usesMap = true,
     .usesDepth = true,
     .conservative = true,
     .occluderTau = 0.5F,
     .help = "occlusion map in which occluders hide only what lies behind them"},
    {.name = "hiz",
     .id = CullMode::kHiz,
     .culls = true,
     .testsOcclusion = true,
     .usesDepth = true,
     .twoPhases = true,
     .conservative = true,
     .needsHistory = true,
     .help = "two phases against a depth pyramid, never culls a visible object"},
};
static_assert(policy::isInOrder(kModes));

}  // namespace

std::span<const CullModeRow> cullModeTable() {
  return kModes;
}

const CullModeRow& rowOf(CullMode mode) {
  return policy::row(cullModeTable(), mode);
}

gpu::uint traitsOf(CullMode mode) {
  const CullModeRow& row = rowOf(mode);
  return (row.culls ? gpu::kTraitCulls : 0) | (row.testsOcclusion ? gpu::kTraitTestsOcclusion : 0) |
         (row.usesMap ? gpu::kTraitUsesMap : 0) | (row.usesDepth ? gpu::kTraitUsesDepth : 0) |
         (row.twoPhases ? gpu::kTraitTwoPhases : 0);
}

}  // namespace jalousie
