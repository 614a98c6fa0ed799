// One row per view.
#include "policy/view.h"

#include "policy/table.h"

namespace jalousie {
namespace {

constexpr ViewRow kViews[] = {
    {.name = "shaded", .id = View::kShaded, .help = "shaded surfaces"},
    {.name = "lod", .id = View::kLod, .help = "LODs, occluders red, other objects blue, coarser levels lighter"},
    {.name = "lv", .id = View::kLv, .showsLv = true, .help = "heat map of the level of visibility"},
    {.name = "occlusion",
     .id = View::kOcclusion,
     .needsOcclusionTest = true,
     .replacesFrame = true,
     .help = "the occlusion map or depth pyramid"},
    {.name = "phase",
     .id = View::kPhase,
     .needsTwoPhases = true,
     .help = "drawn in phase 1 (grey), in phase 2 (orange), in phase 1 although occluded (red)"},
    {.name = "coverage",
     .id = View::kCoverage,
     .needsOcclusionTest = true,
     .measuresCover = true,
     .help = "heat map of the covered share of the block in front of each object"},
    {.name = "holes",
     .id = View::kHoles,
     .needsOcclusionTest = true,
     .measuresCover = true,
     .help = "heat map of the mean open chord of that block"},
    {.name = "wireframe", .id = View::kWireframe, .addsPass = true, .help = "triangle edges over the colours of lod"},
    {.name = "overdraw", .id = View::kOverdraw, .addsPass = true, .help = "surfaces drawn per pixel"},
    {.name = "ghosts",
     .id = View::kGhosts,
     .addsPass = true,
     .help = "culled objects, transparent, over the shaded frame"},
    {.name = "levels", .id = View::kLevels, .help = "LODs, each level in a colour of its own"},
    {.name = "density", .id = View::kDensity, .addsPass = true, .help = "heat map of triangles per pixel"},
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
