// Masking: exact factors, the packed cover, and the levels that follow from them.
#include "visibility/masking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "policy/lod_rule.h"
#include "scene/scene_data.h"
#include "shared/limits.h"
#include "visibility/lod_policy.h"
#include "visibility/overlap_reference.h"

namespace jalousie::visibility {
namespace {

gpu::uint coverOf(float share, float chordPixels) {
  return glm::packHalf2x16({share, chordPixels});
}

TEST(Masking, FactorIsAPowerOfTheMeanChord) {
  // (64 / d)^0.3
  for (const auto& [chord, factor] :
       {std::pair{1.0F, 3.4822022F}, {2.0F, 2.8284271F}, {8.0F, 1.8660660F}, {32.0F, 1.2311444F}, {64.0F, 1.0F}})
    EXPECT_NEAR(maskingFactor(coverOf(0.75F, chord)), factor, 1e-5F) << chord;
}

TEST(Masking, FactorDoesNotDependOnTheShareWhereSomethingIsCovered) {
  for (const float share : {0.01F, 0.5F, 0.99F})
    EXPECT_FLOAT_EQ(maskingFactor(coverOf(share, 8.0F)), maskingFactor(coverOf(0.75F, 8.0F)));
}

TEST(Masking, ChordsBelowAPixelAndAboveTheLimitCountAsTheEnds) {
  EXPECT_FLOAT_EQ(maskingFactor(coverOf(1.0F, 0.0F)), maskingFactor(coverOf(0.75F, 1.0F)));
  EXPECT_FLOAT_EQ(maskingFactor(coverOf(0.75F, 0.25F)), maskingFactor(coverOf(0.75F, 1.0F)));
  EXPECT_EQ(maskingFactor(coverOf(0.75F, 1000.0F)), 1.0F);
  EXPECT_EQ(maskingFactor(coverOf(0.75F, INFINITY)), 1.0F);
}

TEST(Masking, NothingInFrontMasksNothing) {
  EXPECT_EQ(maskingFactor(gpu::kCoverOpen), 1.0F);
  EXPECT_EQ(maskingFactor(coverOf(0.0F, 2.0F)), 1.0F);
  EXPECT_EQ(maskingFactor(0), 1.0F) << "a cover that was never written";
}

TEST(Masking, CoverHoldsShareAndChordInPixels) {
  // Columns of one texel, every other one open: along rows all neighbours differ, along columns none do. With 240 of
  // 480 pairs, the chord is 2 * 0.5 * 480 / 240 = 2 texels.
  std::vector<float> stripes;
  stripes.reserve(256);
  for (int i = 0; i < 256; ++i)
    stripes.push_back(i % 2 == 0 ? 1.0F : 0.0F);
  const glm::vec2 cover = glm::unpackHalf2x16(packedCover({16, 16, stripes}, 4.0F));
  EXPECT_EQ(cover.x, 0.5F);
  EXPECT_EQ(cover.y, 8.0F);
  EXPECT_EQ(packedCover({16, 16, std::vector<float>(256, 0.0F)}, 1.0F), gpu::kCoverOpen);
  EXPECT_EQ(glm::unpackHalf2x16(packedCover({16, 16, std::vector<float>(256, 1.0F)}, 4.0F)), glm::vec2(1.0F, 0.0F));
}

TEST(Masking, HolesBelowATexelOfTheBlockDoNotMask) {
  // An occlusion map holds means: behind a fine sieve all texels are equal, and nothing says how large the holes are.
  EXPECT_EQ(maskingFactor(packedCover({16, 16, std::vector<float>(256, 0.75F)}, 4.0F)), 1.0F);
  std::vector<float> checkerboard;
  checkerboard.reserve(256);
  for (int i = 0; i < 256; ++i)
    checkerboard.push_back(static_cast<float>((i + i / 16) % 2));
  EXPECT_NEAR(maskingFactor(packedCover({16, 16, checkerboard}, 4.0F)), 2.2973967F, 1e-3F) << "(64 / 4)^0.3";
}

TEST(Masking, NeedsTheTrait) {
  EXPECT_EQ(maskingInUse(coverOf(0.75F, 2.0F), ~gpu::kTraitMasksError), 1.0F);
  EXPECT_NEAR(maskingInUse(coverOf(0.75F, 2.0F), gpu::kTraitMasksError), 2.8284271F, 1e-5F);
}

/// Level of a chain with errors of 1, 2, 4, ... pixels, at a visible share and behind holes.
struct MaskedObject {
  explicit MaskedObject(LodRule rule) {
    view.traits = traitsOf(rule) | gpu::kTraitMasksError;
    view.maxTessellation = 20;
    view.relax = 64.0F;
    view.maxError = std::numeric_limits<float>::infinity();
    view.hysteresis = 1.0F;
    for (std::uint32_t k = 0; k < 12; ++k) {
      gpu::Lod& lod = levels.emplace_back();
      lod.errorObject = k == 0 ? 0.0F : std::ldexp(0.125F, static_cast<int>(k));
      lod.meanErrorObject = lod.errorObject;
      lod.triangleCount = 1U << (20 - k);
    }
  }
  std::uint32_t lod(float tau, gpu::uint cover, gpu::uint marks = 0) const {
    gpu::ObjectState state{gpu::kVerdictPartial, 0, 20, lv};
    const DetailInput input{.levels = levels,
                            .patches = patches,
                            .pixelsPerUnit = pixelsPerUnit,
                            .tau = tau,
                            .area = 1000.0F,
                            .surfaceObject = surfaceObject,
                            .last = state,
                            .cover = cover};
    chooseDetail(view, input, state, marks);
    return state.lod;
  }

  gpu::CullView view{};
  std::vector<gpu::Lod> levels;
  gpu::Lod patches{};
  float lv = -1.0F;
  float pixelsPerUnit = 1.0F;
  float surfaceObject = 1e9F;  // not thin
};

TEST(Masking, AllowsTheErrorOfAsManyTimesTheBudget) {
  const gpu::uint holes = coverOf(0.5F, 2.0F);
  for (const LodRule rule : {LodRule::kPixelError, LodRule::kLvError}) {
    for (const float lv : {-1.0F, 0.2F, 0.9F}) {
      MaskedObject object(rule);
      object.lv = lv;
      for (float tau = 0.05F; tau < 100.0F; tau *= 1.37F)
        EXPECT_EQ(object.lod(tau, holes), object.lod(tau * maskingFactor(holes), gpu::kCoverOpen))
            << "tau " << tau << ", LV " << lv;
    }
  }
}

TEST(Masking, InAPriceTheErrorOfEveryPixelCountsLess) {
  // (n + 1) min(e, cap) / f + p T is least at the same level as (n + 1) min(e, cap) + f p T; p grows with tau^2.
  const gpu::uint holes = coverOf(0.5F, 2.0F);
  MaskedObject object(LodRule::kPrice);
  int coarser = 0;
  for (float tau = 0.001F; tau < 10.0F; tau *= 1.17F) {
    const std::uint32_t masked = object.lod(tau, holes);
    EXPECT_EQ(masked, object.lod(tau * std::sqrt(maskingFactor(holes)), gpu::kCoverOpen)) << "tau " << tau;
    coarser += masked > object.lod(tau, gpu::kCoverOpen) ? 1 : 0;
  }
  EXPECT_GT(coarser, 5);
}

TEST(Masking, DoesNotMoveTheLimitOfTheDeviationButThatOfThinObjects) {
  MaskedObject object(LodRule::kPrice);
  object.view.maxError = 3.0F;
  const gpu::uint holes = coverOf(0.5F, 2.0F);
  EXPECT_EQ(object.levels[object.lod(1000.0F, holes)].errorObject, 2.0F) << "the limit is of pixels on the screen";
  object.view.maxError = 1000.0F;
  object.surfaceObject = 1.0F;  // thin
  EXPECT_EQ(object.levels[object.lod(2.0F, gpu::kCoverOpen)].errorObject, 2.0F) << "no coarser than pixel-error";
  EXPECT_EQ(object.levels[object.lod(2.0F, holes)].errorObject, 4.0F) << "no coarser than pixel-error with masking";
}

TEST(Masking, CalmLevelsAreRelaxedAndMaskedWithinOneLimit) {
  MaskedObject object(LodRule::kLvError);
  object.lv = 1.0F;
  const gpu::uint marks = gpu::kMarkRemembered;
  for (const gpu::uint cover : {gpu::kCoverOpen, coverOf(0.5F, 1.0F)})
    EXPECT_EQ(object.levels[object.lod(1.001F, cover, marks)].errorObject, gpu::kMostCalmRelaxed);
}

TEST(Masking, ALateObjectBehindSmallHolesGetsACoarserLevel) {
  gpu::CullView view{};
  view.traits = traitsOf(LodRule::kPixelError) | gpu::kTraitMasksError;
  view.maxTessellation = 20;
  scene::SceneData scene;
  for (const float error : {0.0F, 0.5F, 1.0F, 2.0F, 4.0F}) {
    gpu::Lod& lod = scene.lods.emplace_back();
    lod.errorObject = error;
    lod.triangleCount = 10;
  }
  gpu::Chain chain{};
  chain.lodCount = 5;
  const auto levelBehind = [&](gpu::uint cover, gpu::uint marks) {
    ObjectDecision object{{gpu::kVerdictPending, 0, 20, -1.0F}, {}, marks};
    object.box.pixelsPerUnit = 1.0F;
    object.box.tau = 1.0F;
    object.box.cover = cover;
    applyOverlap({gpu::kVerdictPartial, -1.0F}, scene, view, chain, object);
    return object.state.lod;
  };
  EXPECT_EQ(levelBehind(gpu::kCoverOpen, 0), 2U) << "an error of 1 pixel";
  EXPECT_EQ(levelBehind(coverOf(0.75F, 64.0F), 0), 2U) << "behind a window";
  EXPECT_EQ(levelBehind(coverOf(0.75F, 2.0F), 0), 3U) << "an error of 2 / 2.83 pixels";
  EXPECT_EQ(levelBehind(coverOf(0.75F, 1.0F), 0), 3U) << "an error of 2 / 3.48 pixels; 4 / 3.48 is more";
  EXPECT_EQ(levelBehind(coverOf(0.75F, 1.0F), gpu::kMarkCounted), 0U) << "classify.comp has chosen";
  EXPECT_EQ(levelBehind(coverOf(0.75F, 1.0F), gpu::kMarkEarly), 0U) << "already drawn";
  view.traits = traitsOf(LodRule::kPixelError);
  EXPECT_EQ(levelBehind(coverOf(0.75F, 1.0F), 0), 0U) << "without masking, classify.comp has chosen";
}

}  // namespace
}  // namespace jalousie::visibility
