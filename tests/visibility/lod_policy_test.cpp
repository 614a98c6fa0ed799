// The thesis' mapping from LV to detail.
#include "visibility/lod_policy.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "policy/frame_policy.h"
#include "shared/limits.h"

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
  EXPECT_FLOAT_EQ(projectedScale(2.0F, 600.0F, 10.0F, 0.1F), 120.0F);
  EXPECT_FLOAT_EQ(projectedScale(1.0F, 600.0F, 0.0F, 0.1F), 6000.0F) << "inside the box the near plane counts";
}

std::vector<gpu::Lod> levelsWithErrors(std::initializer_list<float> errors) {
  std::vector<gpu::Lod> levels;
  for (const float error : errors) {
    levels.emplace_back();
    levels.back().errorObject = levels.back().meanErrorObject = error;
    levels.back().triangleCount = 1U << (20 - levels.size());
  }
  return levels;
}

gpu::Lod patchBase(float error) {
  gpu::Lod lod{};
  lod.errorObject = lod.meanErrorObject = error;
  lod.triangleCount = 100;
  return lod;
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

std::vector<gpu::Lod> levelsWithCoverage(std::initializer_list<float> thresholds) {
  std::vector<gpu::Lod> levels = levelsWithErrors({});
  for (const float threshold : thresholds)
    levels.emplace_back().leastCoverage = threshold;
  return levels;
}

TEST(Coverage, TakesTheFinestLevelThatIsReached) {
  const auto levels = levelsWithCoverage({0.5F, 0.2F, 0.01F});
  EXPECT_EQ(coverageLod(levels, 1.0F), 0U);
  EXPECT_EQ(coverageLod(levels, 0.5F), 0U) << "equal counts as reached";
  EXPECT_EQ(coverageLod(levels, 0.49F), 1U);
  EXPECT_EQ(coverageLod(levels, 0.1F), 2U);
  EXPECT_EQ(coverageLod(levels, 0.001F), 2U) << "below the last threshold an object is not lost";
  EXPECT_EQ(coverageLod(levels, 0.0F), 2U);
  EXPECT_EQ(coverageLod(levelsWithCoverage({0.5F}), 0.0F), 0U);
}

TEST(Coverage, UnknownThresholdsAndCoveragesGiveFineLevels) {
  EXPECT_EQ(coverageLod(levelsWithCoverage({0.0F, 0.0F, 0.0F}), 0.0F), 0U) << "a chain without thresholds";
  EXPECT_EQ(coverageLod(levelsWithCoverage({0.5F, 0.0F, 0.0F}), 1e-9F), 1U) << "level 2 has no threshold";
  const auto levels = levelsWithCoverage({std::numeric_limits<float>::max(), 0.2F, 0.0F});
  EXPECT_EQ(coverageLod(levels, std::nanf("")), 0U);
  EXPECT_EQ(coverageLod(levels, std::numeric_limits<float>::infinity()), 0U);
  EXPECT_EQ(coverageLod(levels, -1.0F), 2U);
}

TEST(Coverage, IsThatOfTheBoundingSphere) {
  // A cube of side 2 has a sphere of diameter sqrt(12), here of 3464 pixels.
  const float expected = 0.25F * std::numbers::pi_v<float> * 12.0F * 1e6F / (1920.0F * 1080.0F);
  EXPECT_NEAR(sphereCoverage(glm::vec3(2.0F), 1000.0F, 1920.0F * 1080.0F), expected, 1e-5F * expected);
}

TEST(Coverage, BakedThresholdsMeanOnePixelOnTheScreenTheyAreMadeFor) {
  const auto errors = {0.0F, 0.001F, 0.002F, 0.011F, 0.05F};
  std::vector<gpu::Lod> levels = levelsWithErrors(errors);
  constexpr float kScreen = 1920.0F * 1080.0F;
  const glm::vec3 size(1.0F, 2.0F, 0.5F);
  const float diagonal = glm::length(size);
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {  // as bake::screenCoverage
    const float diameter = diagonal / levels[k + 1].errorObject;
    levels[k].leastCoverage = 0.25F * std::numbers::pi_v<float> * diameter * diameter / kScreen;
  }
  for (float pixelsPerUnit = 1.0F; pixelsPerUnit < 5000.0F; pixelsPerUnit *= 1.0173F) {
    for (const float tau : {0.5F, 1.0F, 3.0F}) {
      EXPECT_EQ(coverageLod(levels, sphereCoverage(size, pixelsPerUnit, kScreen) / (tau * tau)),
                pixelErrorLod(levels, pixelsPerUnit, tau))
          << pixelsPerUnit << " pixels per unit, tau " << tau;
    }
  }
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

TEST(LvError, BudgetGrowsWithTheInverseFourthRootOfWhatIsVisible) {
  EXPECT_FLOAT_EQ(relaxedBudget(-1.0F, 64.0F), 1.0F);
  EXPECT_FLOAT_EQ(relaxedBudget(-1.8F, 64.0F), 1.0F) << "LV may lie below -1";
  EXPECT_NEAR(relaxedBudget(1.0F - 2.0F / 16.0F, 64.0F), 2.0F, 1e-5F) << "a sixteenth is visible";
  EXPECT_NEAR(relaxedBudget(1.0F - 2.0F / 10000.0F, 64.0F), 10.0F, 1e-2F);
  EXPECT_FLOAT_EQ(relaxedBudget(1.0F, 64.0F), 65.0F);
  EXPECT_FLOAT_EQ(relaxedBudget(1.0F, 0.0F), 1.0F) << "without relaxing it is the projected error";
}

TEST(LvError, PixelsCountAgainstHalfTheRectangle) {
  EXPECT_FLOAT_EQ(pixelsLv(5000.0F, 10000.0F), -1.0F);
  EXPECT_FLOAT_EQ(pixelsLv(9000.0F, 10000.0F), -1.0F) << "a box that fills its rectangle is not more than open";
  EXPECT_NEAR(pixelsLv(500.0F, 10000.0F), 0.8F, 0.002F) << "a tenth of the silhouette";
  EXPECT_GT(pixelsLv(0.0F, 10000.0F), 0.99F);
  EXPECT_FLOAT_EQ(pixelsLv(0.0F, 0.0F), -1.0F) << "of a speck nothing can be said";
  for (float visible = 0.0F; visible < 600.0F; ++visible)
    EXPECT_LE(pixelsLv(visible + 1.0F, 1000.0F), pixelsLv(visible, 1000.0F));
}

TEST(LvError, RelaxesLevelsOfTheChainAndOfTessellation) {
  const auto levels = levelsWithErrors({0.0F, 0.01F, 0.04F, 0.2F});
  gpu::CullView view{};
  view.traits = traitsOf(LodRule::kLvError);
  view.relax = 24.0F;
  view.maxTessellation = 20;
  gpu::ScreenBox box{};
  box.pixelsPerUnit = 100.0F;
  box.tau = 1.0F;
  gpu::uint marks = 0;
  gpu::ObjectState open{gpu::kVerdictOpen, 0, 20, -1.0F};
  chooseDetail(view, {levels, patchBase(1.0F), box.pixelsPerUnit, box.tau, 0.0F, 1.0F, {}, true, {}}, open, marks);
  EXPECT_EQ(open.lod, 1U);
  EXPECT_EQ(open.tessellation, 10U);
  gpu::ObjectState hidden{gpu::kVerdictPartial, 0, 20, 1.0F};
  chooseDetail(view, {levels, patchBase(1.0F), box.pixelsPerUnit, box.tau, 0.0F, 1.0F, {}, true, {}}, hidden, marks);
  EXPECT_EQ(hidden.lod, 3U);
  EXPECT_EQ(hidden.tessellation, 2U);
  EXPECT_EQ(marks, 0U) << "what was not drawn before neither switches nor fades";
}

TEST(LvError, ACoarserLevelMustSaveWhatItsErrorCosts) {
  auto levels = levelsWithErrors({0.0F, 1.0F, 2.0F, 4.0F});
  const std::uint32_t triangles[] = {8000, 4000, 2000, 1900};
  for (std::size_t k = 0; k < 4; ++k)
    levels[k].triangleCount = triangles[k];
  EXPECT_EQ(relaxedLod(levels, 1.0F, 1.0F, 1.0F, 1.0F), 1U) << "not relaxed: the projected error";
  EXPECT_EQ(relaxedLod(levels, 1.0F, 1.0F, 10.0F, 1.0F), 1U) << "in full sight 3 more of error buy 0.5 of triangles";
  EXPECT_EQ(relaxedLod(levels, 1.0F, 1.0F, 10.0F, 0.1F), 2U) << "0.3 buy 0.5; then 1.2 buy 0.025";
  EXPECT_EQ(relaxedLod(levels, 1.0F, 1.0F, 10.0F, 1e-4F), 3U);
  EXPECT_EQ(relaxedLod(levels, 1.0F, 1.0F, 2.5F, 1e-4F), 2U) << "never above the relaxed budget";
  EXPECT_EQ(relaxedLod(levels, 1.0F, 0.0F, 10.0F, 0.1F), 0U);
}

/// A baked dragon: triangles, and largest and mean deviation in percent of its diagonal.
std::vector<gpu::Lod> dragonLevels() {
  struct Row {
    std::uint32_t triangles;
    float largest, mean;
  };
  constexpr Row kRows[] = {{202434, 0, 0},
                           {101217, 1.0720F, 0.00377F},
                           {50608, 1.0764F, 0.00931F},
                           {25304, 1.0917F, 0.01849F},
                           {12652, 1.1044F, 0.03232F},
                           {6325, 1.5905F, 0.05483F},
                           {3163, 1.5905F, 0.09661F},
                           {1582, 1.8608F, 0.18318F},
                           {790, 4.6919F, 0.42314F},
                           {562, 10.3131F, 1.24489F}};
  std::vector<gpu::Lod> levels;
  for (const Row& row : kRows) {
    levels.emplace_back();
    levels.back().triangleCount = row.triangles;
    levels.back().errorObject = 0.01F * row.largest;
    levels.back().meanErrorObject = 0.01F * row.mean;
  }
  return levels;
}

constexpr float kUnlimited = std::numeric_limits<float>::infinity();

/// Levels chosen from far to near. The object fills a fifth of the square over its diagonal.
template <class Rule>
std::set<std::uint32_t> levelsOfAnApproach(const Rule& rule) {
  std::set<std::uint32_t> chosen;
  std::uint32_t last = ~0U;
  for (float diagonalPixels = 0.5F; diagonalPixels < 2e6F; diagonalPixels *= 1.02F) {
    const std::uint32_t level = rule(diagonalPixels, 0.2F * diagonalPixels * diagonalPixels);
    EXPECT_LE(level, last) << diagonalPixels;
    chosen.insert(last = level);
  }
  return chosen;
}

TEST(Price, TakesEveryStoredLevelAtSomeDistance) {
  const auto levels = dragonLevels();
  const float price = gpu::kTrianglePrice;
  const std::set<std::uint32_t> chosen = levelsOfAnApproach([&](float scale, float pixels) {
    return pricedLod(levels, scale, {pixels, price, kUnlimited});
  });
  EXPECT_EQ(chosen.size(), levels.size());
  const std::set<std::uint32_t> limited = levelsOfAnApproach([&](float scale, float pixels) {
    return pricedLod(levels, scale, {pixels, price, gpu::kDefaultMaxError});
  });
  EXPECT_EQ(limited.size(), levels.size());
  const std::set<std::uint32_t> byLargest =
      levelsOfAnApproach([&](float scale, float) { return pixelErrorLod(levels, scale, 1.0F); });
  EXPECT_FALSE(byLargest.contains(5)) << "the largest deviation of level 6 is the same";
}

TEST(Price, IsTheLeastSumOfVisibleErrorAndTriangles) {
  auto levels = levelsWithErrors({0.0F, 0.5F, 1.0F, 8.0F});
  const std::uint32_t triangles[] = {8000, 4000, 2000, 100};
  for (std::size_t k = 0; k < 4; ++k)
    levels[k].triangleCount = triangles[k];
  EXPECT_EQ(pricedLod(levels, 1.0F, {99.0F, 0.01F, kUnlimited}), 0U) << "80, 90, 120, 201";
  EXPECT_EQ(pricedLod(levels, 1.0F, {99.0F, 0.02F, kUnlimited}), 1U) << "160, 130, 140, 202";
  EXPECT_EQ(pricedLod(levels, 1.0F, {99.0F, 0.03F, kUnlimited}), 2U) << "240, 170, 160, 203";
  EXPECT_EQ(pricedLod(levels, 1.0F, {99.0F, 0.06F, kUnlimited}), 3U) << "480, 290, 220, 206: the error has its cap";
  EXPECT_EQ(pricedLod(levels, 1.0F, {99.0F, 0.06F, 7.9F}), 2U) << "beyond the limit";
  EXPECT_EQ(pricedLod(levels, 1.0F, {0.0F, 0.01F, kUnlimited}), 3U) << "no pixel shows it";
  levels[2].triangleCount = 3000;
  EXPECT_EQ(pricedLod(levels, 1.0F, {99.0F, 0.05F, 7.9F}), 1U) << "equal: the finer one";
}

TEST(Price, OddInputTakesALevelOfTheChain) {
  const float nan = std::nanf("");
  const auto unknown = levelsWithErrors({0.0F, kUnlimited, kUnlimited});
  EXPECT_EQ(pricedLod(unknown, 1.0F, {0.0F, 1000.0F, kUnlimited}), 0U) << "unknown errors are never chosen";
  EXPECT_EQ(pricedLod(unknown, 0.0F, {0.0F, 1000.0F, kUnlimited}), 0U);
  const auto levels = levelsWithErrors({0.0F, 0.5F, 1.0F});
  EXPECT_EQ(pricedLod(levels, 1.0F, {10.0F, 0.0F, kUnlimited}), 0U) << "triangles for nothing";
  EXPECT_EQ(pricedLod(levels, nan, {10.0F, 1.0F, kUnlimited}), 0U);
  EXPECT_EQ(pricedLod(levels, 1.0F, {nan, 1.0F, kUnlimited}), 0U);
  EXPECT_EQ(pricedLod(levels, 1.0F, {10.0F, nan, kUnlimited}), 0U);
  EXPECT_EQ(pricedLod(levels, 1.0F, {10.0F, 1.0F, nan}), 0U);
  EXPECT_EQ(pricedLod(levels, 1.0F, {4e9F, 1e-9F, kUnlimited}), 0U);
  EXPECT_EQ(pricedLod(levels, kUnlimited, {0.0F, 1e9F, kUnlimited}), 2U) << "as wrong as it can be, and cheap";
  EXPECT_EQ(pricedLod(levelsWithErrors({0.0F}), 1.0F, {0.0F, 1e9F, kUnlimited}), 0U);
}

TEST(Price, TessellationWeighsItsTrianglesToo) {
  EXPECT_EQ(pricedTessellation(16.0F, 100.0F, {1000.0F, 0.0F, kUnlimited}, 20), 20U);
  EXPECT_EQ(pricedTessellation(16.0F, 100.0F, {0.0F, 1000.0F, kUnlimited}, 20), 1U);
  EXPECT_EQ(pricedTessellation(16.0F, 100.0F, {0.0F, 1000.0F, 1.0F}, 20), 4U) << "the limit of the deviation";
  EXPECT_EQ(pricedTessellation(16.0F, 100.0F, {0.0F, 1000.0F, 0.0F}, 20), 20U);
  EXPECT_EQ(pricedTessellation(16.0F, 100.0F, {0.0F, 1.0F, kUnlimited}, 1), 1U);
  EXPECT_EQ(pricedTessellation(std::nanf(""), 100.0F, {10.0F, 1.0F, kUnlimited}, 20), 20U);
  std::uint32_t last = 20;
  for (float price = 1e-4F; price < 10.0F; price *= 1.5F) {
    const std::uint32_t level = pricedTessellation(16.0F, 100.0F, {1000.0F, price, kUnlimited}, 20);
    EXPECT_LE(level, last);
    last = level;
  }
  EXPECT_LT(last, 3U);
}

TEST(Price, PixelsAreThoseThatLvCameFrom) {
  for (const float area : {100.0F, 5000.0F, 200000.0F})
    for (const float pixels : {0.0F, 1.0F, 7.0F, 49.0F})
      EXPECT_NEAR(visiblePixels(pixelsLv(pixels, area), area), pixels, 0.02F) << area;
  EXPECT_FLOAT_EQ(visiblePixels(-1.0F, 1000.0F), 500.0F);
  EXPECT_FLOAT_EQ(visiblePixels(-1.8F, 1000.0F), 500.0F) << "LV may lie below -1";
  EXPECT_EQ(visiblePixels(1.0F, 1000.0F), 0.0F);
}

/// One object whose budget an outside force changes from frame to frame.
struct CalmObject {
  explicit CalmObject(Detail detail = Detail::kDiscrete) {
    view.traits = traitsOf(LodRule::kPixelError) | traitsOf(detail);
    view.maxTessellation = 20;
    view.calm = 1;
    view.hysteresis = gpu::kDefaultHysteresis;
    view.fadeFrames = gpu::kDefaultFadeFrames;
    box.pixelsPerUnit = 1.0F;
    marks = gpu::kMarkKnown | gpu::kMarkRemembered;
  }
  void frame(float tau, bool seen = true) {
    box.tau = tau;
    marks = gpu::kMarkKnown | gpu::kMarkRemembered | (marks & gpu::kMarkFadeMask);
    gpu::ObjectState next{gpu::kVerdictPartial, 0, 0, state.lv};
    chooseDetail(view, {levels, patchBase(40.0F), box.pixelsPerUnit, box.tau, area, 1e6F, {}, seen, state}, next,
                 marks);
    state = next;
  }
  bool switched() const { return (marks & gpu::kMarkSwitched) != 0; }

  std::vector<gpu::Lod> levels = levelsWithErrors({0.0F, 1.0F, 2.0F, 4.0F, 8.0F});
  gpu::CullView view{};
  gpu::ScreenBox box{};
  float area = 10000.0F;  // pixels
  gpu::ObjectState state{gpu::kVerdictPartial, 2, 5, -1.0F};
  gpu::uint marks = 0;
};

TEST(Calm, AnErrorWithinTheMarginKeepsTheLevel) {
  const float margin = gpu::kDefaultHysteresis;
  CalmObject object;  // at level 2, whose error is 2 pixels; the next one's is 4
  for (const float tau : {2.0F, 1.01F * 2.0F / margin, 0.99F * 4.0F * margin, 1.01F * 2.0F / margin}) {
    object.frame(tau);
    EXPECT_EQ(object.state.lod, 2U) << "tau " << tau;
    EXPECT_FALSE(object.switched());
  }
  object.frame(0.99F * 2.0F / margin);
  EXPECT_EQ(object.state.lod, 1U);
  EXPECT_TRUE(object.switched());
  CalmObject coarser;
  coarser.frame(1.01F * 4.0F * margin);
  EXPECT_EQ(coarser.state.lod, 3U);
}

TEST(Calm, OneLevelAStepAndNoOtherWhileItFades) {
  CalmObject object;
  std::vector<std::uint32_t> lods;
  std::vector<std::uint32_t> frames;
  for (std::uint32_t i = 0; i < 2 * gpu::kDefaultFadeFrames + 1; ++i) {
    object.frame(100.0F);
    lods.push_back(object.state.lod);
    frames.push_back(fadeFrames(object.marks));
    if (frames.back() > 0) {
      EXPECT_EQ(fadingLod(object.state.lod, object.marks), object.state.lod - 1);
    }
  }
  for (std::uint32_t i = 0; i < gpu::kDefaultFadeFrames; ++i) {
    EXPECT_EQ(lods[i], 3U);
    EXPECT_EQ(frames[i], gpu::kDefaultFadeFrames - i);
    EXPECT_EQ(lods[gpu::kDefaultFadeFrames + i], 4U);
  }
  EXPECT_EQ(lods.back(), 4U);
  EXPECT_EQ(frames.back(), 0U);
  object.frame(0.0F);
  EXPECT_EQ(object.state.lod, 3U);
  EXPECT_EQ(fadingLod(object.state.lod, object.marks), 4U) << "finer: the coarser level goes";
}

TEST(Calm, TheMarginAndTheFadeAreTheViews) {
  CalmObject object;
  object.view.hysteresis = 1.0F;
  object.frame(4.0F);  // exactly the error of the next level
  EXPECT_EQ(object.state.lod, 3U);
  object.view.fadeFrames = 3;
  object.frame(4.0F);
  EXPECT_EQ(fadeFrames(object.marks), 3U) << "a fade that runs is shortened";
  object.view.fadeFrames = 0;
  object.frame(4.0F);
  EXPECT_EQ(fadeFrames(object.marks), 0U) << "and ended";
  object.frame(8.0F);
  EXPECT_EQ(object.state.lod, 4U);
  EXPECT_EQ(fadeFrames(object.marks), 0U) << "no fade: the level switches at once";
  CalmObject wide;
  wide.view.hysteresis = 4.0F;
  wide.frame(3.9F * 4.0F);
  EXPECT_EQ(wide.state.lod, 2U);
}

TEST(Calm, AFadeEndsWithTheCalmFrames) {
  for (const LodRuleRow& rule : lodRuleTable()) {
    CalmObject object;
    object.frame(100.0F);
    ASSERT_GT(fadeFrames(object.marks), 0U);
    object.view.traits = traitsOf(rule.id);
    gpu::uint marks = gpu::kMarkKnown | (object.marks & gpu::kMarkFadeMask);  // not remembered
    gpu::ObjectState next{gpu::kVerdictPartial, 0, 0, -1.0F};
    chooseDetail(object.view,
                 {object.levels,
                  patchBase(40.0F),
                  object.box.pixelsPerUnit,
                  object.box.tau,
                  object.area,
                  1e6F,
                  {},
                  true,
                  object.state},
                 next, marks);
    EXPECT_EQ(fadeFrames(marks), 0U) << rule.name;
  }
}

TEST(Calm, WhatNobodySeesGoesStraightToItsLevel) {
  CalmObject object;
  object.frame(100.0F);
  object.frame(100.0F, false);  // in the middle of a fade
  EXPECT_EQ(object.state.lod, 4U);
  EXPECT_EQ(fadeFrames(object.marks), 0U);
}

TEST(Calm, TessellationMovesOneLevelAFrameWithinItsMargin) {
  CalmObject object(Detail::kTessellation);
  object.frame(1.6F);  // 40 / 25 = 1.6: level 5 is exact
  EXPECT_EQ(object.state.tessellation, 5U);
  object.frame(1.4F);
  EXPECT_EQ(object.state.tessellation, 5U);
  object.frame(0.1F);  // wants 20
  EXPECT_EQ(object.state.tessellation, 6U);
  EXPECT_EQ(fadeFrames(object.marks), 0U);
}

TEST(Calm, LvComesIntoSightFasterThanItGoes) {
  EXPECT_FLOAT_EQ(smoothLv(1.0F, -1.0F), 1.0F - 2.0F * gpu::kSmoothAppearing);
  EXPECT_FLOAT_EQ(smoothLv(-1.0F, 1.0F), -1.0F + 2.0F * gpu::kSmoothHiding);
  EXPECT_GT(gpu::kSmoothAppearing, gpu::kSmoothHiding);
  EXPECT_FLOAT_EQ(smoothLv(-1.8F, -1.8F), -1.0F) << "LV below -1 is no more open than -1";
  EXPECT_FLOAT_EQ(forgottenLv(1.0F), 1.0F - 2.0F * gpu::kSmoothHiding);
  EXPECT_FLOAT_EQ(forgottenLv(-1.8F), -1.0F);
}

TEST(Calm, WhatNobodySawNeedNotSwitchWhenItComesIntoSight) {
  CalmObject object;
  object.view.traits = traitsOf(LodRule::kLvError);
  object.view.relax = 64.0F;
  for (std::size_t k = 0; k < object.levels.size(); ++k)
    object.levels[k].triangleCount = 4096U >> k;
  object.state.lod = 0;
  object.state.lv = 1.0F;
  object.frame(1.0F, false);
  const std::uint32_t hiddenLod = object.state.lod;
  EXPECT_GT(hiddenLod, 0U) << "hidden, it is drawn coarser";
  object.state.lv = -1.0F;
  object.frame(1.0F);
  EXPECT_EQ(object.state.lod, hiddenLod);
  EXPECT_FALSE(object.switched());
}

/// One object under a price, in calm frames.
struct PricedObject : CalmObject {
  explicit PricedObject(Detail detail = Detail::kDiscrete) : CalmObject(detail) {
    view.traits = traitsOf(LodRule::kPrice) | traitsOf(detail);
    view.maxError = kUnlimited;
    levels = dragonLevels();
    box.pixelsPerUnit = 200.0F;
    area = 20000.0F;
    frame(1.0F);
  }
};

TEST(Calm, APriceKeepsTheLevelWithinTheMarginAndThenMovesByOne) {
  PricedObject object;
  const std::uint32_t settled =
      pricedLod(object.levels, object.box.pixelsPerUnit, {0.5F * object.area, gpu::kTrianglePrice, kUnlimited});
  object.state.lod = settled;
  object.marks = 0;  // no fade
  for (const float tau : {1.3F, 0.8F, 1.0F, 1.5F, 0.7F}) {
    object.frame(tau);
    EXPECT_EQ(object.state.lod, settled) << tau;
  }
  object.frame(100.0F);
  EXPECT_EQ(object.state.lod, settled + 1);
  EXPECT_EQ(fadeFrames(object.marks), gpu::kDefaultFadeFrames);
  PricedObject patches(Detail::kTessellation);
  patches.state.tessellation = 5;
  patches.frame(1e-3F);
  EXPECT_EQ(patches.state.tessellation, 6U);
}

TEST(Calm, ThePixelsThatAppearFirstDoNotChangeThePricedLevel) {
  PricedObject object;
  object.state.lv = 1.0F;
  object.frame(2.0F, false);
  const std::uint32_t hiddenLod = object.state.lod;
  for (const float pixels : {0.0F, 1.0F, 8.0F, 16.0F}) {
    object.state.lv = pixelsLv(pixels, object.area);
    object.frame(2.0F, pixels > 0.0F);
    EXPECT_EQ(object.state.lod, hiddenLod) << pixels;
  }
}

TEST(Calm, TheLimitOfTheDeviationHoldsForWhatNobodySees) {
  PricedObject object;
  object.view.maxError = 3.0F;
  object.box.pixelsPerUnit = 1000.0F;
  object.state.lv = 1.0F;
  object.frame(100.0F, false);
  EXPECT_LE(object.levels[object.state.lod].errorObject * object.box.pixelsPerUnit, 3.0F);
  gpu::uint marks = gpu::kMarkKnown | gpu::kMarkCounted;  // not calm
  gpu::ObjectState next{gpu::kVerdictPartial, 0, 0, 1.0F};
  const DetailInput unseen{object.levels, patchBase(1.0F), 1000.0F, 100.0F, object.area, 1e6F, {}, false, object.state};
  chooseDetail(object.view, unseen, next, marks);
  EXPECT_EQ(next.lod, 9U) << "without a visible pixel nothing is limited";
}

}  // namespace
}  // namespace jalousie::visibility
