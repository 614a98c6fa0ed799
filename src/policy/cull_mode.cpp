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
    {.name = "query-wait",
     .id = CullMode::kQueryWait,
     .culls = true,
     .conservative = true,
     .readsBack = true,
     .asksQueries = true,
     .countsSamples = true,
     .help = "occlusion queries front to back; waits for each answer"},
    {.name = "query-batch",
     .id = CullMode::kQueryBatch,
     .culls = true,
     .conservative = true,
     .readsBack = true,
     .asksQueries = true,
     .countsSamples = true,
     .batchesQueries = true,
     .help = "occlusion queries front to back in batches; waits for each batch"},
    {.name = "chc-flat",
     .id = CullMode::kChcFlat,
     .culls = true,
     .conservative = true,
     .needsHistory = true,
     .readsBack = true,
     .asksQueries = true,
     .countsSamples = true,
     .batchesQueries = true,
     .help = "occlusion queries front to back; what was visible in the last frame is drawn before its answer"},
    {.name = "chc",
     .id = CullMode::kChc,
     .culls = true,
     .conservative = true,
     .needsHistory = true,
     .readsBack = true,
     .asksQueries = true,
     .countsSamples = true,
     .batchesQueries = true,
     .help = "coherent hierarchical culling: as chc-flat, over a hierarchy of objects"},
    {.name = "chc++",
     .id = CullMode::kChcPlusPlus,
     .culls = true,
     .conservative = true,
     .needsHistory = true,
     .readsBack = true,
     .asksQueries = true,
     .countsSamples = true,
     .batchesQueries = true,
     .joinsQueries = true,
     .help = "chc with batches, queries for several nodes and tight bounds"},
    {.name = "nested-grid",
     .id = CullMode::kNestedGrid,
     .culls = true,
     .conservative = true,
     .readsBack = true,
     .asksQueries = true,
     .countsSamples = true,
     .batchesQueries = true,
     .help = "queries for the cells of nested grids, slab by slab; waits for each batch of a slab"},
    {.name = "eye-siding",
     .id = CullMode::kEyeSiding,
     .culls = true,
     .conservative = true,
     .readsBack = true,
     .asksQueries = true,
     .countsSamples = true,
     .asksUnits = true,
     .help = "queries for groups of grid nodes that cannot hide each other; waits for each group"},
    {.name = "query-conditional",
     .id = CullMode::kQueryConditional,
     .culls = true,
     .conservative = true,
     .asksQueries = true,
     .batchesQueries = true,
     .help = "query-batch by conditional rendering; waits for nothing"},
    {.name = "query-buffer",
     .id = CullMode::kQueryBuffer,
     .culls = true,
     .conservative = true,
     .asksQueries = true,
     .countsSamples = true,
     .batchesQueries = true,
     .help = "query-batch with counts that only the GPU reads; waits for nothing"},
    {.name = "planar",
     .id = CullMode::kPlanar,
     .culls = true,
     .conservative = true,
     .castsShadows = true,
     .help = "shadows of the occluders that the file has, face by face; no depth is read"},
    {.name = "solid",
     .id = CullMode::kSolid,
     .culls = true,
     .conservative = true,
     .castsShadows = true,
     .help = "planar with whole convex solids, which hide more than their faces"},
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
