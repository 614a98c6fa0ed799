// The pictures of the modes that cast shadows against those without culling.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "render/methods/method_fixture.h"

namespace jalousie::render {
namespace {

std::vector<CullMode> shadowModes() {
  std::vector<CullMode> modes;
  for (const CullModeRow& row : cullModeTable())
    if (row.castsShadows) modes.push_back(row.id);
  return modes;
}

/// Around a town, between its houses, in them, and from place to place.
test::Journey journeyThrough(const asset::SceneFile& file, std::uint64_t seed, bool moves) {
  test::Journey journey{"town", scene::buildScene(file), {}, {}};
  journey.camera = test::tour(journey.scene, 6, seed);
  if (moves) journey.move = test::swingObjects(journey.scene, 3);
  return journey;
}

class ShadowsGl : public MethodGl {
 protected:
  const scene::SceneData town_ = scene::buildScene(test::town(30, 300, 4));
  const scene::Camera inStreet_ = scene::lookAt({-34, 2, 3}, {0, 1.5F, 0}, town_.boundsWorld);
};

TEST_F(ShadowsGl, NoPixelAndNoDepthIsLost) {
  for (const CullMode mode : shadowModes()) {
    std::uint64_t culled = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const test::Journey journey = journeyThrough(test::town(25, 200, seed), seed, seed % 2 == 1);
      FrameOptions frameOptions = options(mode);
      if (seed % 3 == 0) frameOptions.lodRule = LodRule::kFinest;
      if (seed % 3 == 1) frameOptions.occluders.rankEvery = 5;
      const test::CullingLoss loss = test::countLoss(journey, kOddWidth, kOddHeight, frameOptions, 0, 24);
      EXPECT_EQ(loss.wrongPixels, 0U) << rowOf(mode).name << ", town " << seed;
      EXPECT_EQ(loss.differentDepths, 0U) << rowOf(mode).name << ", town " << seed;
      culled += loss.culled;
    }
    EXPECT_GT(culled, 1000U) << rowOf(mode).name;
  }
}

TEST_F(ShadowsGl, OccludersThatAreALittleTooLargeAreNoticed) {
  std::uint64_t wrong = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed)
    wrong += test::countLoss(journeyThrough(test::town(25, 200, seed, 1.1F), seed, false), kOddWidth, kOddHeight,
                             options(CullMode::kSolid), 0, 24)
                 .wrongPixels;
  EXPECT_GT(wrong, 0U);
}

TEST_F(ShadowsGl, EveryLevelRuleGivesThePictureWithoutCulling) {
  for (const CullMode mode : shadowModes()) {
    for (const LodRuleRow& rule : lodRuleTable()) {
      if (rule.followsLv) continue;  // levels follow counted pixels, which start without a count
      FrameOptions frameOptions = options(mode);
      frameOptions.lodRule = rule.id;
      FrameOptions full = frameOptions;
      full.cullMode = CullMode::kFull;
      const Frame frame = draw(town_, frameOptions, inStreet_);
      EXPECT_EQ(frame.pixels, draw(town_, full, inStreet_).pixels) << rule.name;
      EXPECT_GT(frame.statistics.culledOcclusion, 0U) << rule.name;
    }
  }
}

/// Counted pixels are those of the picture, so that levels by visibility do not depend on what is culled.
TEST_F(ShadowsGl, LevelsByVisibilityAreThoseOfFrustumCulling) {
  for (const CullMode mode : shadowModes()) {
    for (const LodRuleRow& rule : lodRuleTable()) {
      if (!rule.followsLv) continue;
      FrameRenderer shadows(town_, kOddWidth, kOddHeight);
      FrameRenderer frustum(town_, kOddWidth, kOddHeight);
      for (int frame = 0; frame < 6; ++frame) {
        FrameOptions frameOptions = options(mode);
        frameOptions.lodRule = rule.id;
        frameOptions.lvMeasure = LvMeasure::kPixels;
        shadows.render(frameOptions, inStreet_, inStreet_);
        frameOptions.cullMode = CullMode::kFrustum;
        frustum.render(frameOptions, inStreet_, inStreet_);
      }
      const std::vector<gpu::ObjectState> states = shadows.readStates();
      const std::vector<gpu::ObjectState> expected = frustum.readStates();
      const std::vector<gpu::uint> counts = frustum.readPixelCounts();
      std::uint64_t hidden = 0;
      for (std::size_t object = 0; object < states.size(); ++object) {
        if (states[object].verdict == gpu::kVerdictOccluded) {
          ++hidden;
          EXPECT_EQ(counts[object], 0U) << rule.name << ", object " << object;
        } else {
          EXPECT_EQ(states[object].lod, expected[object].lod) << rule.name << ", object " << object;
        }
      }
      EXPECT_GT(hidden, 0U) << rule.name;
    }
  }
}

TEST_F(ShadowsGl, OptionsChangeHowMuchIsCulledAndNeverThePicture) {
  const std::vector<std::uint8_t> expected = draw(town_, options(CullMode::kFull), inStreet_).pixels;
  std::uint64_t culled[2] = {0, 0};
  for (const CullMode mode : shadowModes()) {
    std::uint64_t last = 0;
    for (const std::uint32_t active : {0U, 1U, 5U, 15U, 32U}) {
      for (const culling::Cap cap : {culling::Cap::kExact, culling::Cap::kPaper}) {
        for (const culling::Rank rank : {culling::Rank::kSolidAngle, culling::Rank::kPaper}) {
          FrameOptions frameOptions = options(mode);
          frameOptions.occluders = {.active = active, .rankEvery = 1, .cap = cap, .rank = rank};
          const Frame frame = draw(town_, frameOptions, inStreet_);
          EXPECT_EQ(frame.pixels, expected) << rowOf(mode).name << " " << active;
          EXPECT_LE(frame.statistics.shadows, active);
          if (cap != culling::Cap::kExact || rank != culling::Rank::kSolidAngle) continue;
          EXPECT_GE(frame.statistics.culledOcclusion, last) << "more occluders";
          last = frame.statistics.culledOcclusion;
        }
      }
    }
    culled[mode == CullMode::kSolid ? 1 : 0] = last;
  }
  EXPECT_GT(culled[0], 0U);
  EXPECT_GE(culled[1], culled[0]) << "solids hide more than their faces";
}

TEST_F(ShadowsGl, AFrozenCullingCameraIsShownFromOutside) {
  const scene::Camera above = scene::lookAt({0, 60, 40}, {0, 0, 0}, town_.boundsWorld);
  for (const CullMode mode : shadowModes()) {
    const Frame usual = draw(town_, options(mode), inStreet_);
    const Frame frozen = draw(town_, options(mode), inStreet_, above);
    EXPECT_EQ(frozen.statistics.drawn, usual.statistics.drawn);
    EXPECT_NE(frozen.pixels, draw(town_, options(CullMode::kFrustum), inStreet_, above).pixels)
        << "objects are missing";
  }
}

TEST_F(ShadowsGl, OccludersThatDoNotHoldAtEveryLevelAreForTheFinest) {
  const scene::SceneData someLevels = scene::buildScene(test::town(0, 300, 4, 1.0F, 3));
  const scene::Camera camera = scene::lookAt({-34, 2, 3}, {0, 1.5F, 0}, someLevels.boundsWorld);
  for (const CullMode mode : shadowModes()) {
    FrameOptions frameOptions = options(mode);
    EXPECT_EQ(draw(someLevels, frameOptions, camera).statistics.shadows, 0U);
    frameOptions.lodRule = LodRule::kFinest;
    EXPECT_GT(draw(someLevels, frameOptions, camera).statistics.shadows, 0U);
  }
}

TEST_F(ShadowsGl, ObjectsThatAreHiddenByHandHideNothing) {
  const asset::SceneFile file = test::town(30, 300, 4);
  std::vector<std::uint32_t> houses(30);
  std::iota(houses.begin(), houses.end(), 1U);  // after the ground
  const scene::SceneData without = scene::buildScene(file, {.hidden = houses});
  FrameOptions frameOptions = options(CullMode::kSolid);
  const Frame frame = draw(without, frameOptions, inStreet_);
  EXPECT_LT(frame.statistics.culledOcclusion, draw(town_, frameOptions, inStreet_).statistics.culledOcclusion);
  frameOptions.cullMode = CullMode::kFull;
  EXPECT_EQ(frame.pixels, draw(without, frameOptions, inStreet_).pixels);
}

TEST_F(ShadowsGl, CurvedPatchesCastNone) {
  const scene::SceneData patches = scene::buildScene(test::town(30, 300, 4), {.patches = true});
  for (const CullMode mode : shadowModes()) {
    FrameOptions frameOptions = options(mode);
    EXPECT_GT(draw(patches, frameOptions, inStreet_).statistics.shadows, 0U);
    frameOptions.detail = Detail::kTessellation;
    const Frame frame = draw(patches, frameOptions, inStreet_);
    EXPECT_EQ(frame.statistics.shadows, 0U);
    frameOptions.cullMode = CullMode::kFull;
    EXPECT_EQ(frame.pixels, draw(patches, frameOptions, inStreet_).pixels);
  }
}

TEST_F(ShadowsGl, OrthographicCamerasLoseNoPixel) {
  for (const CullMode mode : shadowModes()) {
    std::uint64_t culled = 0;
    for (const glm::vec3& eye : {glm::vec3(-50, 3, 3), glm::vec3(50, 12, -20), glm::vec3(10, 2, 50)}) {
      scene::Camera camera = scene::lookAt(eye, {0, 2, 0}, town_.boundsWorld);
      camera.halfSize = glm::vec2(24.0F, 13.5F);
      camera.zFar = 200.0F;
      const Frame frame = draw(town_, options(mode), camera);
      EXPECT_EQ(frame.pixels, draw(town_, options(CullMode::kFull), camera).pixels) << rowOf(mode).name;
      culled += frame.statistics.culledOcclusion;
    }
    EXPECT_GT(culled, 0U) << rowOf(mode).name;
  }
}

TEST_F(ShadowsGl, TwoRunsGiveTheSameMarks) {
  for (const CullMode mode : shadowModes()) {
    FrameRenderer first(town_, kOddWidth, kOddHeight);
    FrameRenderer second(town_, kOddWidth, kOddHeight);
    for (FrameRenderer* renderer : {&first, &second})
      renderer->render(options(mode), inStreet_, inStreet_);
    EXPECT_EQ(first.readMarks(), second.readMarks());
  }
}

}  // namespace
}  // namespace jalousie::render
