// One row per measure.
#include "policy/lv_measure.h"

#include "policy/table.h"

namespace jalousie {
namespace {

constexpr LvMeasureRow kMeasures[] = {
    {.name = "none", .id = LvMeasure::kNone, .help = "every object counts as fully visible"},
    {.name = "thesis",
     .id = LvMeasure::kThesis,
     .trait = gpu::kTraitLvThesis,
     .help = "level of visibility from four DCT coefficients"},
    {.name = "spectral",
     .id = LvMeasure::kSpectral,
     .trait = gpu::kTraitLvSpectral,
     .help = "share of high frequencies in the open area; kept for comparison"},
    {.name = "chord",
     .id = LvMeasure::kChord,
     .trait = gpu::kTraitLvChord,
     .measuresHoles = true,
     .help = "covered share, reduced where the mean open chord is long"},
    {.name = "coverage", .id = LvMeasure::kCoverage, .trait = gpu::kTraitLvCoverage, .help = "covered share alone"},
    {.name = "pixels",
     .id = LvMeasure::kPixels,
     .trait = gpu::kTraitLvPixels,
     .countsPixels = true,
     .help = "visible pixels counted in a recent frame"},
};
static_assert(policy::isInOrder(kMeasures));
static_assert(std::size(kMeasures) == kLvMeasureCount);

}  // namespace

std::span<const LvMeasureRow> lvMeasureTable() {
  return kMeasures;
}

const LvMeasureRow& rowOf(LvMeasure measure) {
  return policy::row(lvMeasureTable(), measure);
}

gpu::uint traitsOf(LvMeasure measure) {
  return rowOf(measure).trait;
}

}  // namespace jalousie
