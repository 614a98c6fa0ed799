// The culling modes: one table that command line, panel, legends, comparison, kernels, CPU twins and docs read.
#pragma once

#include <span>

#include "shared/traits.h"

namespace jalousie {

/// How objects that cannot be seen are found. Values index cullModeTable().
enum class CullMode : gpu::uint {
  kFull,      ///< no culling
  kFrustum,   ///< frustum culling
  kHom,       ///< hierarchical occlusion map (Zhang 1997; thesis ch. 3)
  kHomDepth,  ///< the same map, where a texel occludes only what lies behind it
  kHiz,       ///< two phases against the depth of what was visible in the last frame
  // Hardware occlusion queries over a spatial hierarchy (docs/occlusion_queries.md).
  kQueryWait,         ///< leaves front to back, one query at a time
  kQueryBatch,        ///< leaves front to back, queries in batches
  kChcFlat,           ///< leaves front to back; what was visible in the last frame is drawn before its answer
  kChc,               ///< coherent hierarchical culling (Bittner et al. 2004)
  kChcPlusPlus,       ///< CHC++ (Mattausch et al. 2008)
  kNestedGrid,        ///< nested grids, slab by slab (Hillesland et al. 2002)
  kEyeSiding,         ///< units of equal eye-siding over a loose grid
  kQueryConditional,  ///< batches, drawn by conditional rendering
  kQueryBuffer,       ///< batches whose counts only kernels read
  // Shadows of occluders that are known before the frame (docs/object_space_occlusion.md).
  kPlanar,  ///< of convex polygons (Hudson et al. 1997)
  kSolid,   ///< of convex solids and polygons
  // Rooms and portals of the file (docs/cells_and_portals.md).
  kPortals,  ///< what is seen through a row of portals (Luebke and Georges 1995)
};

/// One row of the table. Every property of a mode stands here and nowhere else.
struct CullModeRow {
  const char* name;  ///< value of --mode
  CullMode id;
  bool culls = false;           ///< objects outside the frustum or below --min-pixels are not drawn
  bool testsOcclusion = false;  ///< analyse.comp tests objects against a map or pyramid; block measures need this
  bool usesMap = false;         ///< occluders are drawn into an occlusion map before the test
  bool usesDepth = false;       ///< the test compares with a depth pyramid
  bool twoPhases = false;       ///< objects visible in the last frame are drawn before the test
  bool conservative = false;    ///< with default options no visible pixel is lost
  bool needsHistory = false;    ///< the frame depends on the frames before it
  bool readsBack = false;       ///< the CPU waits for the GPU inside the frame
  bool asksQueries = false;     ///< occlusion queries decide, while the frame is drawn in slices
  bool countsSamples = false;   ///< with asksQueries: how many samples pass can be compared with --query-threshold
  bool batchesQueries = false;  ///< with asksQueries: --query-batch applies
  bool joinsQueries = false;    ///< with asksQueries: --multiquery, --tight-bounds and --requery apply
  bool asksUnits = false;       ///< with asksQueries: --query-units and --plane-depth apply
  bool castsShadows = false;    ///< occluders of the file hide what lies behind them; decided on the CPU
  bool seesRooms = false;       ///< rooms of the file are seen through their portals; decided on the CPU
  float occluderTau = 0.0F;     ///< default of --occluder-tau, pixels; with usesMap
  const char* help;             ///< phrase for --help, panel and docs
};

/// All modes, in the order of CullMode.
std::span<const CullModeRow> cullModeTable();
const CullModeRow& rowOf(CullMode mode);
/// kTrait... of shared/traits.h.
gpu::uint traitsOf(CullMode mode);

}  // namespace jalousie
