// One row per detail path.
#include "policy/detail.h"

#include "policy/table.h"

namespace jalousie {
namespace {

constexpr DetailRow kDetails[] = {
    {.name = "discrete", .id = Detail::kDiscrete, .help = "discrete LOD chain"},
    {.name = "tessellation",
     .id = Detail::kTessellation,
     .patches = true,
     .help = "Phong tessellation of the coarsest level"},
};
static_assert(policy::isInOrder(kDetails));

}  // namespace

std::span<const DetailRow> detailTable() {
  return kDetails;
}

const DetailRow& rowOf(Detail detail) {
  return policy::row(detailTable(), detail);
}

gpu::uint traitsOf(Detail detail) {
  return rowOf(detail).patches ? gpu::kTraitPatches : 0;
}

}  // namespace jalousie
