// One row per view.
#include "policy/view.h"

#include "policy/table.h"

namespace jalousie {
namespace {

constexpr ViewRow kViews[] = {
    {.name = "shaded",
     .id = View::kShaded,
     .needsOcclusionTest = false,
     .needsTwoPhases = false,
     .showsLv = false,
     .measuresCover = false,
     .replacesFrame = false,
     .addsPass = false,
     .help = "shaded surfaces"},
    {.name = "lod",
     .id = View::kLod,
     .needsOcclusionTest = false,
     .needsTwoPhases = false,
     .showsLv = false,
     .measuresCover = false,
     .replacesFrame = false,
     .addsPass = false,
     .help = "LODs, occluders red, other objects blue, coarser levels lighter"},
    {.name = "lv",
     .id = View::kLv,
     .needsOcclusionTest = false,
     .needsTwoPhases = false,
     .showsLv = true,
     .measuresCover = false,
     .replacesFrame = false,
     .addsPass = false,
     .help = "heat map of the level of visibility"},
    {.name = "occlusion",
     .id = View::kOcclusion,
     .needsOcclusionTest = true,
     .needsTwoPhases = false,
     .showsLv = false,
     .measuresCover = false,
     .replacesFrame = true,
     .addsPass = false,
     .help = "the occlusion map or depth pyramid"},
    {.name = "phase",
     .id = View::kPhase,
     .needsOcclusionTest = false,
     .needsTwoPhases = true,
     .showsLv = false,
     .measuresCover = false,
     .replacesFrame = false,
     .addsPass = false,
     .help = "drawn in phase 1 (grey), in phase 2 (orange), in phase 1 although occluded (red)"},
    {.name = "coverage",
     .id = View::kCoverage,
     .needsOcclusionTest = true,
     .needsTwoPhases = false,
     .showsLv = false,
     .measuresCover = true,
     .replacesFrame = false,
     .addsPass = false,
     .help = "heat map of the covered share of the block in front of each object"},
    {.name = "holes",
     .id = View::kHoles,
     .needsOcclusionTest = true,
     .needsTwoPhases = false,
     .showsLv = false,
     .measuresCover = true,
     .replacesFrame = false,
     .addsPass = false,
     .help = "heat map of the mean open chord of that block"},
    {.name = "wireframe",
     .id = View::kWireframe,
     .needsOcclusionTest = false,
     .needsTwoPhases = false,
     .showsLv = false,
     .measuresCover = false,
     .replacesFrame = false,
     .addsPass = true,
     .help = "triangle edges over the colours of lod"},
    {.name = "overdraw",
     .id = View::kOverdraw,
     .needsOcclusionTest = false,
     .needsTwoPhases = false,
     .showsLv = false,
     .measuresCover = false,
     .replacesFrame = false,
     .addsPass = true,
     .help = "surfaces drawn per pixel"},
    {.name = "ghosts",
     .id = View::kGhosts,
     .needsOcclusionTest = false,
     .needsTwoPhases = false,
     .showsLv = false,
     .measuresCover = false,
     .replacesFrame = false,
     .addsPass = true,
     .help = "culled objects, transparent, over the shaded frame"},
};
static_assert(policy::isInOrder(kViews));
static_assert(std::size(kViews) == gpu::kViewCount);

}  // namespace

std::span<const ViewRow> viewTable() {
  return kViews;
}

const ViewRow& rowOf(View view) {
  return policy::row(viewTable(), view);
}

}  // namespace jalousie
