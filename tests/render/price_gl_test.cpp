// Levels at one price: what is in full sight, and a budget of triangles from frame to frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/frame_renderer.h"
#include "support/gl_test.h"
#include "support/stages.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 360;

FrameOptions priceOptions(LodRule rule = LodRule::kPrice) {
  FrameOptions options;
  options.lodRule = rule;
  options.lvMeasure = rowOf(rule).measure;
  return options;
}

void renderFrames(FrameRenderer& renderer, const FrameOptions& options, const scene::Camera& camera, int frames) {
  for (int frame = 0; frame < frames; ++frame)
    renderer.render(options, camera, camera);
}

class PriceGl : public test::GlTest {};

TEST_F(PriceGl, AThinRopeAloneIsNoCoarserThanByPixelError) {
  asset::SceneFile file = test::sphereChain(5);
  for (asset::Mesh& mesh : file.meshes)
    for (glm::vec3& position : mesh.primitives[0].positions)
      position *= glm::vec3(3.0F, 0.0015F, 0.0015F);
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1), 0.6F, {0, 0, 1});
  const scene::SceneData scene = scene::buildScene(file);
  const scene::Camera camera = scene::lookAt({0, 0, 7}, {0, 0, 0}, scene.boundsWorld);
  FrameRenderer renderer(scene, kWidth, kHeight);
  for (const float tau : {0.5F, 1.0F, 2.0F, 4.0F}) {
    FrameOptions options = priceOptions(LodRule::kPixelError);
    options.tau = tau;
    renderFrames(renderer, options, camera, 1);
    const gpu::uint byError = renderer.readObject(0).state.lod;
    options = priceOptions();
    options.tau = tau;
    renderer.resetHistory();
    renderFrames(renderer, options, camera, 10);
    const ObjectReadout rope = renderer.readObject(0);
    const float area = (rope.box.maxX - rope.box.minX) * (rope.box.maxY - rope.box.minY);
    ASSERT_GT(rope.pixels, 10U);
    ASSERT_LT(static_cast<float>(rope.pixels), 0.02F * area) << "its rectangle is almost empty";
    EXPECT_LE(rope.state.lod, byError) << "tau " << tau;
  }
}

TEST_F(PriceGl, WhatNobodySeesIsCoarserThanWhatIsInSight) {
  asset::SceneFile file = test::sphereChain(5);
  for (int i = 0; i < 3; ++i)
    test::addInstance(file, 0, {0, 0, -2.5F * static_cast<float>(i)}, glm::vec3(1));
  const scene::SceneData scene = scene::buildScene(file);
  const scene::Camera camera = scene::lookAt({0, 0, 4}, {0, 0, 0}, scene.boundsWorld);
  FrameRenderer renderer(scene, 2 * kWidth, 2 * kHeight);
  FrameOptions options = priceOptions();
  options.cullMode = CullMode::kFrustum;
  renderFrames(renderer, options, camera, 3);
  const std::vector<gpu::ObjectState> states = renderer.readStates();
  ASSERT_EQ(renderer.readPixelCounts()[2], 0U);
  EXPECT_LE(states[0].lod, 1U);
  EXPECT_EQ(states[2].lod, 4U) << "no pixel, no limit of the deviation";
  options.calm = true;
  renderFrames(renderer, options, camera, 60);
  EXPECT_LT(renderer.readStates()[2].lod, 4U) << "calm, the limit holds for all";
}

TEST_F(PriceGl, FramesKeepTheirBudgetOfTriangles) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(400, 10.0F, 4));
  const scene::Camera camera = scene::lookAt({4, 3, 32}, {0, 0.5F, 0}, scene.boundsWorld);
  FrameRenderer renderer(scene, kWidth / 2, kHeight / 2);
  FrameOptions options = priceOptions();
  options.maxError = 0.0F;
  renderFrames(renderer, options, camera, 10);
  const auto free = static_cast<double>(renderer.readStatistics().triangles);
  for (const bool calm : {false, true}) {
    options.calm = calm;
    for (const double share : {0.5, 0.8, 1.5}) {
      options.triangleBudget = static_cast<gpu::uint>(share * free);
      renderFrames(renderer, options, camera, calm ? 80 : 24);
      for (int frame = 0; frame < 8; ++frame) {
        renderFrames(renderer, options, camera, 1);
        const auto triangles = static_cast<double>(renderer.readStatistics().triangles);
        EXPECT_NEAR(triangles / (share * free), 1.0, 0.02) << share << (calm ? ", calm" : "");
      }
    }
  }
  options.calm = false;
  options.triangleBudget = 0;
  renderFrames(renderer, options, camera, 10);
  EXPECT_NEAR(static_cast<double>(renderer.readStatistics().triangles), free, 0.01 * free) << "the price of tau";
}

/// Most triangles of a frame along half a turn, a cut to the other side, and another one, closer and farther.
double mostTriangles(FrameRenderer& renderer, const scene::SceneData& scene, const FrameOptions& options) {
  renderer.resetHistory();
  double most = 0.0;
  for (int frame = 0; frame < 40; ++frame) {
    const float angle = 0.08F * static_cast<float>(frame) + (frame < 20 ? 0.0F : 3.0F);
    const float radius = 24.0F + 8.0F * std::sin(0.3F * static_cast<float>(frame));
    const glm::vec3 eye(radius * std::sin(angle), 3.0F, radius * std::cos(angle));
    renderFrames(renderer, options, scene::lookAt(eye, {0, 0, 0}, scene.boundsWorld), 1);
    most = std::max(most, static_cast<double>(renderer.readStatistics().triangles));
  }
  return most;
}

TEST_F(PriceGl, NoFrameOfAMovingCameraExceedsItsBudgetByMoreThanATenth) {
  constexpr gpu::uint kBudget = 60000;
  for (const scene::CellOptions& cells : {scene::CellOptions{}, {scene::CellOptions::Kind::kCount, 64}}) {
    const scene::SceneData scene = scene::buildScene(test::randomSpheres(400, 10.0F, 4), {.cells = cells});
    FrameRenderer renderer(scene, kWidth / 2, kHeight / 2);
    FrameOptions options = priceOptions();
    for (const CullMode mode : {CullMode::kHiz, CullMode::kFrustum}) {
      options.cullMode = mode;
      for (const bool calm : {false, true}) {
        SCOPED_TRACE(testing::Message() << scene.cells.objects.size() << " cells, " << rowOf(mode).name << ", "
                                        << calm);
        options.calm = calm;
        options.triangleBudget = 0;
        EXPECT_GT(mostTriangles(renderer, scene, options), 1.5 * kBudget) << "without a budget";
        options.triangleBudget = kBudget;
        // The cells of objects that the first phase has drawn become visible at the level that it has drawn.
        const bool knowsAll = scene.cells.objects.empty() || mode == CullMode::kFrustum;
        EXPECT_LT(mostTriangles(renderer, scene, options), (knowsAll ? 1.1 : 1.6) * kBudget);
      }
    }
  }
}

TEST_F(PriceGl, ABudgetGivesTheSameFramesAgain) {
  const scene::SceneData scene = scene::buildScene(test::randomSpheres(200, 10.0F, 4));
  const scene::Camera camera = scene::lookAt({4, 3, 32}, {0, 0.5F, 0}, scene.boundsWorld);
  FrameRenderer reading(scene, kWidth, kHeight);
  FrameRenderer blind(scene, kWidth, kHeight);
  FrameOptions options = priceOptions();
  options.triangleBudget = 20000;
  for (int frame = 0; frame < 12; ++frame) {
    renderFrames(reading, options, camera, 1);
    reading.readStatistics();  // one waits for the figures of every frame, the other never does
    renderFrames(blind, options, camera, 1);
  }
  EXPECT_EQ(reading.readImage().pixels, blind.readImage().pixels);
  EXPECT_EQ(reading.readStatistics().triangles, blind.readStatistics().triangles);
}

}  // namespace
}  // namespace jalousie::render
