// The thesis' mapping from LV to detail.
#include "visibility/lod_policy.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace jalousie::visibility {
namespace {

TEST(LodPolicy, ThesisExampleGivesLevelFour) {
  EXPECT_EQ(tessellationLevel(641.0F / 1024.0F, 20), 4U);
}

TEST(LodPolicy, EndsMapToFinestAndCoarsest) {
  EXPECT_EQ(tessellationLevel(-1.0F, 20), 20U);
  EXPECT_EQ(tessellationLevel(1.0F, 20), 1U);
  EXPECT_EQ(linearLod(-1.0F, 10), 0U);
  EXPECT_EQ(linearLod(1.0F, 10), 9U);
}

TEST(LodPolicy, ValuesOutsideTheNominalRangeAreClamped) {
  EXPECT_EQ(tessellationLevel(-1.83F, 20), 20U);
  EXPECT_EQ(tessellationLevel(1.5F, 20), 1U);
  EXPECT_EQ(linearLod(-1.83F, 7), 0U);
}

TEST(LodPolicy, DetailNeverGrowsWithHiddenness) {
  for (const unsigned levels : {1U, 2U, 10U, 20U, 32U}) {
    unsigned last = levels;
    for (int step = -200; step <= 200; ++step) {
      const unsigned level = tessellationLevel(static_cast<float>(step) / 150.0F, levels);
      EXPECT_LE(level, last);
      EXPECT_GE(level, 1U);
      EXPECT_EQ(linearLod(static_cast<float>(step) / 150.0F, levels), levels - level);
      last = level;
    }
  }
}

TEST(PixelError, ProjectedScaleIsTheFormula) {
  EXPECT_FLOAT_EQ(projectedScale(2.0F, 600.0F, 13.0F, 3.0F, 0.1F), 120.0F);
  EXPECT_FLOAT_EQ(projectedScale(1.0F, 600.0F, 1.0F, 3.0F, 0.1F), 6000.0F) << "inside the sphere the near plane counts";
}

std::vector<gpu::Lod> levelsWithErrors(std::initializer_list<float> errors) {
  std::vector<gpu::Lod> levels;
  for (const float error : errors) {
    levels.emplace_back();
    levels.back().errorObject = error;
  }
  return levels;
}

TEST(PixelError, TakesTheCoarsestLevelWithinTau) {
  const auto levels = levelsWithErrors({0.0F, 0.01F, 0.04F, 0.2F});
  EXPECT_EQ(pixelErrorLod(levels, 1.0F, 1.0F), 3U);
  EXPECT_EQ(pixelErrorLod(levels, 10.0F, 1.0F), 2U);
  EXPECT_EQ(pixelErrorLod(levels, 100.0F, 1.0F), 1U) << "equal counts as within";
  EXPECT_EQ(pixelErrorLod(levels, 101.0F, 1.0F), 0U);
  EXPECT_EQ(pixelErrorLod(levels, 1e30F, 1.0F), 0U);
  EXPECT_EQ(pixelErrorLod(levelsWithErrors({0.0F}), 1.0F, 1.0F), 0U);
  EXPECT_EQ(pixelErrorLod(levelsWithErrors({0.0F, 0.0F, 0.1F}), 50.0F, 0.0F), 1U) << "tau 0 takes lossless levels";
}

TEST(PixelError, NeverTakesALevelOfUnknownError) {
  const float unknown = std::numeric_limits<float>::infinity();
  EXPECT_EQ(pixelErrorLod(levelsWithErrors({0.0F, unknown}), 1.0F, 1000.0F), 0U);
  EXPECT_EQ(pixelErrorLod(levelsWithErrors({0.0F, unknown}), 0.0F, 1000.0F), 0U) << "not a number is not within";
}

TEST(PixelError, TessellationHalvesTheLevelForFourTimesTheTau) {
  EXPECT_EQ(pixelErrorTessellation(0.5F, 1.0F, 20), 1U);
  EXPECT_EQ(pixelErrorTessellation(16.0F, 1.0F, 20), 4U);
  EXPECT_EQ(pixelErrorTessellation(16.0F, 4.0F, 20), 2U);
  EXPECT_EQ(pixelErrorTessellation(16.1F, 1.0F, 20), 5U) << "rounded up";
  EXPECT_EQ(pixelErrorTessellation(1e9F, 1.0F, 20), 20U);
  EXPECT_EQ(pixelErrorTessellation(1.0F, 0.0F, 20), 20U);
  EXPECT_EQ(pixelErrorTessellation(0.0F, 0.0F, 20), 1U);
}

TEST(LvError, BudgetGrowsWithTheFourthPowerOfHiddenness) {
  EXPECT_FLOAT_EQ(relaxedBudget(-1.0F, 64.0F), 1.0F);
  EXPECT_FLOAT_EQ(relaxedBudget(-1.8F, 64.0F), 1.0F) << "LV may lie below -1";
  EXPECT_FLOAT_EQ(relaxedBudget(0.0F, 64.0F), 5.0F);
  EXPECT_FLOAT_EQ(relaxedBudget(1.0F, 64.0F), 65.0F);
  EXPECT_FLOAT_EQ(relaxedBudget(1.0F, 0.0F), 1.0F) << "without relaxing it is the projected error";
}

TEST(LvError, RelaxesLevelsOfTheChainAndOfTessellation) {
  const auto levels = levelsWithErrors({0.0F, 0.01F, 0.04F, 0.2F});
  gpu::CullView view{};
  view.lodRule = gpu::kLodLvError;
  view.relax = 24.0F;
  view.maxTessellation = 20;
  gpu::ScreenBox box{};
  box.pixelsPerUnit = 100.0F;
  box.tau = 1.0F;
  gpu::ObjectState open{gpu::kVerdictOpen, 0, 20, -1.0F};
  chooseDetail(view, levels, 1.0F, box, open);
  EXPECT_EQ(open.lod, 1U);
  EXPECT_EQ(open.tessellation, 10U);
  gpu::ObjectState hidden{gpu::kVerdictPartial, 0, 20, 1.0F};
  chooseDetail(view, levels, 1.0F, box, hidden);
  EXPECT_EQ(hidden.lod, 3U);
  EXPECT_EQ(hidden.tessellation, 2U);
}

}  // namespace
}  // namespace jalousie::visibility
