// Pixels that are counted, levels that stay calm, and fades that leave no trace.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "render/frame_renderer.h"
#include "support/gl_test.h"
#include "support/stages.h"
#include "visibility/item_buffer.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 180;

FrameOptions countingOptions(CullMode mode = CullMode::kHiz) {
  FrameOptions options;
  options.cullMode = mode;
  options.lodRule = LodRule::kLvError;
  options.lvMeasure = LvMeasure::kPixels;
  return options;
}

scene::Camera moved(const scene::Camera& camera, const glm::vec3& offset) {
  scene::Camera result = camera;
  result.worldFromCamera = glm::translate(glm::mat4(1.0F), offset) * camera.worldFromCamera;
  return result;
}

class CountGl : public test::GlTest {};

TEST_F(CountGl, CountsAreWhatTheFrameShowsInEveryModeAndOnBothPaths) {
  for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
    const scene::SceneData scene =
        scene::buildScene(test::spheresBehindWall(0.3F), {.patches = detail == Detail::kTessellation});
    const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
    for (const CullModeRow& mode : cullModeTable()) {
      for (const bool stats : {false, true}) {
        FrameRenderer renderer(scene, kWidth, kHeight);
        FrameOptions options = countingOptions(mode.id);
        options.detail = detail;
        options.maxTessellation = 4;
        options.skipDraw = stats;  // what the counts need is drawn all the same
        options.calm = true;
        for (std::uint32_t frame = 0; frame <= kCountInterval; ++frame)  // the first and the last are counted
          renderer.render(options, camera, camera);
        const std::vector<gpu::uint> counts = renderer.readPixelCounts();
        renderer.renderIds();
        EXPECT_EQ(counts, visibility::countPixels(renderer.readIds(), static_cast<std::uint32_t>(counts.size())))
            << "mode " << mode.name << " detail " << rowOf(detail).name;
        EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 1000U);
      }
    }
  }
}

TEST_F(CountGl, AFrozenCameraCountsWhatItSeesAndNotWhatIsShown) {
  const scene::SceneData scene = scene::buildScene(test::spheresBehindWall(0.3F));
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  const scene::Camera behind = scene::lookAt({3, 1, -9}, {0, 0, 0}, scene.boundsWorld);
  for (const CullMode mode : {CullMode::kFrustum, CullMode::kHiz}) {
    FrameRenderer frozen(scene, kWidth, kHeight);
    FrameRenderer usual(scene, kWidth, kHeight);
    for (int frame = 0; frame < 3; ++frame) {
      frozen.render(countingOptions(mode), camera, behind);
      usual.render(countingOptions(mode), camera, camera);
    }
    EXPECT_EQ(frozen.readPixelCounts(), usual.readPixelCounts());
    EXPECT_EQ(frozen.readStatistics().triangles, usual.readStatistics().triangles);
    EXPECT_NE(frozen.readImage().pixels, usual.readImage().pixels);
  }
}

TEST_F(CountGl, WhatNobodySeesIsDrawnCoarsest) {
  // Spheres in the open rectangle of others cannot be culled by box, but not a pixel of the last one shows.
  asset::SceneFile file = test::sphereChain(5);
  for (int i = 0; i < 3; ++i)
    test::addInstance(file, 0, {0, 0, -2.5F * static_cast<float>(i)}, glm::vec3(1));
  const scene::SceneData scene = scene::buildScene(file);
  const scene::Camera camera = scene::lookAt({0, 0, 4}, {0, 0, 0}, scene.boundsWorld);
  FrameRenderer renderer(scene, 4 * kWidth, 4 * kHeight);
  FrameOptions options = countingOptions(CullMode::kFrustum);
  options.tau = 0.2F;
  for (int frame = 0; frame < 3; ++frame)
    renderer.render(options, camera, camera);
  const std::vector<gpu::ObjectState> states = renderer.readStates();
  const std::vector<gpu::uint> counts = renderer.readPixelCounts();
  ASSERT_GT(counts[0], 1000U);
  ASSERT_EQ(counts[2], 0U);
  options.lodRule = LodRule::kPixelError;
  renderer.render(options, camera, camera);
  const std::vector<gpu::ObjectState> uniform = renderer.readStates();
  EXPECT_EQ(states[0].lod, uniform[0].lod) << "in full sight nothing is relaxed";
  EXPECT_GT(states[2].lod, uniform[2].lod);
}

class FadeGl : public test::GlTest {
 protected:
  /// Single-sided, masked-free, mirrored and double-sided objects whose levels all look alike but for their colour.
  static scene::SceneData twins(bool otherColor) {
    asset::SceneFile file;
    file.materials.resize(3);
    file.materials[0].baseColor = {1.0F, 0.1F, 0.1F, 1.0F};
    file.materials[1].baseColor = otherColor ? glm::vec4(0.1F, 0.1F, 1.0F, 1.0F) : file.materials[0].baseColor;
    file.materials[2].baseColor = {0.2F, 0.8F, 0.2F, 1.0F};
    file.materials[2].doubleSided = true;
    asset::Chain solid{"solid", {}};
    asset::Chain sheet{"sheet", {}};
    for (std::uint32_t level = 0; level < 2; ++level) {
      file.meshes.push_back({"solid", {test::sphere(32, 16, level)}});
      solid.levels.push_back({2 * level, static_cast<float>(level) * 0.01F});
      file.meshes.push_back({"sheet", {test::box(glm::vec3(0.7F), 2)}});
      sheet.levels.push_back({2 * level + 1, static_cast<float>(level) * 0.01F});
    }
    file.chains = {solid, sheet};
    test::addInstance(file, 0, {-1.2F, 0.8F, 0}, glm::vec3(1));
    test::addInstance(file, 0, {1.2F, 0.8F, 0}, glm::vec3(-1, 1, 1));
    test::addInstance(file, 1, {-1.2F, -1.2F, 0}, glm::vec3(1), 0.5F);
    test::addInstance(file, 1, {1.2F, -1.2F, 0}, glm::vec3(1, -1, 1), 0.7F);
    return scene::buildScene(file);
  }

  static FrameOptions options(float tau, CullMode mode) {
    FrameOptions result;
    result.cullMode = mode;
    result.lodRule = LodRule::kPixelError;
    result.tau = tau;
    result.calm = true;
    return result;
  }
};

TEST_F(FadeGl, AFadeBetweenLevelsThatLookAlikeChangesNoPixel) {
  const scene::SceneData scene = twins(false);
  const scene::Camera camera = scene::lookAt({0, 0, 7}, {0, 0, 0}, scene.boundsWorld);
  for (const CullMode mode : {CullMode::kFrustum, CullMode::kHom, CullMode::kHomDepth, CullMode::kHiz}) {
    for (const auto submission : {visibility::Submission::kInstanced, visibility::Submission::kPerObject}) {
      FrameRenderer renderer(scene, kWidth, kHeight, {.submission = submission});
      for (int frame = 0; frame < 3; ++frame)
        renderer.render(options(0.001F, mode), camera, camera);
      const ImageRgba8 image = renderer.readImage();
      const std::uint64_t triangles = renderer.readStatistics().triangles;
      for (gpu::uint frame = 0; frame <= gpu::kDefaultFadeFrames; ++frame) {
        renderer.render(options(100.0F, mode), camera, camera);
        const FrameStatistics statistics = renderer.readStatistics();
        EXPECT_EQ(renderer.readImage().pixels, image.pixels) << "mode " << rowOf(mode).name << " frame " << frame;
        EXPECT_EQ(statistics.fading, frame < gpu::kDefaultFadeFrames ? 4U : 0U);
        EXPECT_EQ(statistics.switches, frame == 0 ? 4U : 0U);
        EXPECT_EQ(statistics.triangles, frame < gpu::kDefaultFadeFrames ? 2 * triangles : triangles)
            << "both levels count";
        EXPECT_EQ(statistics.dropped, 0U);
      }
    }
  }
}

TEST_F(FadeGl, EachFrameGivesANinthOfThePixelsToTheNewLevel) {
  const scene::SceneData scene = twins(true);
  const scene::Camera camera = scene::lookAt({0, 0, 7}, {0, 0, 0}, scene.boundsWorld);
  FrameRenderer renderer(scene, kWidth, kHeight);
  const auto blue = [&] {
    const ImageRgba8 image = renderer.readImage();
    std::size_t count = 0;
    for (std::size_t p = 0; p < image.pixels.size(); p += 4)
      count += image.pixels[p + 2] > 2 * image.pixels[p] ? 1 : 0;
    return static_cast<double>(count);
  };
  renderer.render(options(100.0F, CullMode::kHiz), camera, camera);
  const double all = blue();
  renderer.resetHistory();
  renderer.render(options(0.001F, CullMode::kHiz), camera, camera);
  ASSERT_EQ(blue(), 0.0);
  for (gpu::uint frame = 1; frame <= gpu::kDefaultFadeFrames; ++frame) {
    renderer.render(options(100.0F, CullMode::kHiz), camera, camera);
    EXPECT_NEAR(blue() / all, frame / (gpu::kDefaultFadeFrames + 1.0), 0.05) << "frame " << frame;
  }
  renderer.render(options(100.0F, CullMode::kHiz), camera, camera);
  EXPECT_EQ(blue(), all);
}

TEST_F(FadeGl, AFadeIsAsLongAsItIsToldAndEndsWhereCalmEnds) {
  const scene::SceneData scene = twins(true);
  const scene::Camera camera = scene::lookAt({0, 0, 7}, {0, 0, 0}, scene.boundsWorld);
  for (const gpu::uint frames : {0U, 3U, gpu::kMaxFadeFrames}) {
    FrameRenderer renderer(scene, kWidth, kHeight);
    const auto fadingAfter = [&](FrameOptions next) {
      next.fadeFrames = frames;
      renderer.render(next, camera, camera);
      return renderer.readStatistics().fading;
    };
    for (int i = 0; i < 3; ++i)
      fadingAfter(options(0.001F, CullMode::kHiz));
    for (gpu::uint frame = 0; frame <= frames; ++frame)
      EXPECT_EQ(fadingAfter(options(100.0F, CullMode::kHiz)), frame < frames ? 4U : 0U) << frames << " " << frame;
  }
  FrameRenderer renderer(scene, kWidth, kHeight);
  for (int i = 0; i < 3; ++i)
    renderer.render(options(0.001F, CullMode::kHiz), camera, camera);
  renderer.render(options(100.0F, CullMode::kHiz), camera, camera);
  ASSERT_GT(renderer.readStatistics().fading, 0U);
  FrameOptions plain = options(100.0F, CullMode::kHiz);
  plain.calm = false;
  renderer.render(plain, camera, camera);
  EXPECT_EQ(renderer.readStatistics().fading, 0U);
  const ImageRgba8 image = renderer.readImage();
  renderer.resetHistory();
  renderer.render(plain, camera, camera);
  EXPECT_EQ(renderer.readImage().pixels, image.pixels) << "nothing is left of the fade";
}

class CalmGl : public test::GlTest {
 protected:
  /// Switches over some frames.
  template <class CameraOf>
  static std::uint64_t switches(FrameRenderer& renderer, const FrameOptions& options, int frames,
                                const CameraOf& cameraOf) {
    std::uint64_t sum = 0;
    for (int frame = 0; frame < frames; ++frame) {
      const scene::Camera camera = cameraOf();
      renderer.render(options, camera, camera);
      sum += renderer.readStatistics().switches;
    }
    return sum;
  }
};

TEST_F(CalmGl, JitterSwitchesNothingOnceLevelsHaveSettled) {
  const scene::SceneData scene = scene::buildScene(test::spheresBehindWall(0.3F));
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  Random random(8);
  // 1 % of the distance to what is looked at, in any direction.
  const auto jittered = [&] {
    return moved(camera, 0.06F * glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
  };
  for (const CullMode mode : {CullMode::kFrustum, CullMode::kHiz}) {
    for (const float tau : {0.1F, 0.4F}) {
      FrameRenderer renderer(scene, kWidth, kHeight);
      FrameOptions options = countingOptions(mode);
      options.tau = tau;
      const std::uint64_t restless = switches(renderer, options, 40, jittered);
      options.calm = true;
      switches(renderer, options, 100, jittered);
      EXPECT_EQ(switches(renderer, options, 60, jittered), 0U) << "mode " << rowOf(mode).name << " tau " << tau;
      if (tau == 0.1F) {
        EXPECT_GT(restless, 4U) << "the camera does shake";
      }
    }
  }
}

TEST_F(CalmGl, TheSameFramesGiveTheSameBytes) {
  const scene::SceneData scene = scene::buildScene(test::spheresBehindWall(0.3F));
  FrameRenderer first(scene, kWidth, kHeight);
  FrameRenderer second(scene, kWidth, kHeight, {.fastPaths = false});
  FrameOptions options = countingOptions();
  options.calm = true;
  std::uint64_t fading = 0;
  for (int frame = 0; frame < 30; ++frame) {
    const scene::Camera camera =
        moved(test::cameraBeforeWall(scene.boundsWorld), {0.0F, 0.0F, -0.1F * static_cast<float>(frame)});
    options.tau = 0.3F / (1.0F + static_cast<float>(frame));
    first.render(options, camera, camera);
    second.render(options, camera, camera);
    ASSERT_EQ(first.readImage().pixels, second.readImage().pixels) << "frame " << frame;
    fading += first.readStatistics().fading;
  }
  EXPECT_GT(fading, 20U);
}

}  // namespace
}  // namespace jalousie::render
