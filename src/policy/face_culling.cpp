// One row per test of groups of triangles.
#include "policy/face_culling.h"

#include "policy/table.h"
#include "shared/face_structs.h"

namespace jalousie {
namespace {

constexpr FaceCullingRow kRows[] = {
    {.name = "off", .id = FaceCulling::kOff, .help = "the rasteriser culls back faces"},
    {.name = "mask", .id = FaceCulling::kMask, .help = "by the cells that the normals of a group lie in"},
    {.name = "cluster", .id = FaceCulling::kCluster, .help = "by the culling volume of each group"},
    {.name = "tree", .id = FaceCulling::kTree, .help = "the same from the roots of the trees of groups down"},
    {.name = "cone", .id = FaceCulling::kCone, .help = "by the cone of normals of each group"},
};
static_assert(policy::isInOrder(kRows));
static_assert(static_cast<gpu::uint>(FaceCulling::kOff) == gpu::kFacesOff);
static_assert(static_cast<gpu::uint>(FaceCulling::kMask) == gpu::kFacesMask);
static_assert(static_cast<gpu::uint>(FaceCulling::kCluster) == gpu::kFacesCluster);
static_assert(static_cast<gpu::uint>(FaceCulling::kTree) == gpu::kFacesTree);
static_assert(static_cast<gpu::uint>(FaceCulling::kCone) == gpu::kFacesCone);

}  // namespace

std::span<const FaceCullingRow> faceCullingTable() {
  return kRows;
}

const FaceCullingRow& rowOf(FaceCulling culling) {
  return policy::row(faceCullingTable(), culling);
}

}  // namespace jalousie
