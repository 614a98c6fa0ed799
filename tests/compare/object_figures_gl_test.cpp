// Figures of the objects of a frame: every pixel's error is put down to one object or to the background.
#include "compare/object_figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/gl_test.h"
#include "support/scenes.h"

namespace jalousie::compare {
namespace {

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 120;

class ObjectFiguresTest : public test::GlTest {
 protected:
  /// A large sphere at the left, a smaller one at the right, a tiny one between them, one behind the large one.
  static asset::SceneFile file() {
    asset::SceneFile file = test::sphereChain(4);
    test::addInstance(file, 0, {-1.0F, 0.0F, 0.0F}, glm::vec3(0.8F));
    test::addInstance(file, 0, {1.0F, 0.0F, 0.0F}, glm::vec3(0.4F));
    test::addInstance(file, 0, {0.2F, 0.0F, 0.0F}, glm::vec3(0.05F));
    test::addInstance(file, 0, {-2.0F, 0.0F, -4.0F}, glm::vec3(0.1F));
    return file;
  }
  static scene::Camera camera() {
    return scene::lookAt({0.0F, 0.0F, 4.0F}, {0.0F, 0.0F, 0.0F}, {glm::vec3(-3.0F, -1.0F, -5.0F), glm::vec3(2.0F)});
  }

  static std::vector<std::uint32_t> idsOf(render::FrameRenderer& renderer, const render::FrameOptions& options) {
    renderer.render(options, camera(), camera());
    renderer.renderIds();
    return renderer.readIds();
  }
};

render::FrameOptions pixelError(float tau) {
  render::FrameOptions options;
  options.cullMode = CullMode::kFrustum;
  options.lodRule = LodRule::kPixelError;
  options.tau = tau;
  return options;
}

render::FrameOptions finest() {
  render::FrameOptions options = pixelError(1.0F);
  options.lodRule = LodRule::kFinest;
  return options;
}

TEST_F(ObjectFiguresTest, SharesAddUpToThePicture) {
  const scene::SceneData scene = scene::buildScene(file());
  render::FrameRenderer renderer(scene, kWidth, kHeight);
  const std::vector<std::uint32_t> reference = idsOf(renderer, finest());
  renderer.render(pixelError(2.0F), camera(), camera());
  const std::vector<float> error(reference.size(), 0.5F);
  const ObjectsSample sample = figuresOf(renderer, scene, error, reference, 10);
  EXPECT_DOUBLE_EQ(sample.flip, 0.5 * kWidth * kHeight);
  EXPECT_EQ(sample.listed, 3U) << "the one behind is hidden";
  ASSERT_EQ(sample.rows.size(), 3U);
  double sum = sample.flipOfBackground;
  for (const ObjectFigures& object : sample.rows)
    sum += object.flip;
  EXPECT_DOUBLE_EQ(sum, sample.flip);
  const std::vector<std::uint32_t> ids = renderer.readIds();  // of the last frame: figuresOf drew them
  for (const ObjectFigures& object : sample.rows)
    EXPECT_EQ(object.pixels, std::count(ids.begin(), ids.end(), object.object + 1));
  EXPECT_EQ(sample.rows[0].object, 0U) << "the largest has most pixels, and here most error";
  EXPECT_EQ(sample.rows[2].object, 2U);
}

TEST_F(ObjectFiguresTest, LevelsAndTheirErrorsAreThoseOfTheFrame) {
  const scene::SceneData scene = scene::buildScene(file());
  render::FrameRenderer renderer(scene, kWidth, kHeight);
  const std::vector<std::uint32_t> reference = idsOf(renderer, finest());
  const std::vector<float> error(reference.size(), 1.0F);
  renderer.render(pixelError(0.5F), camera(), camera());
  const std::vector<gpu::ObjectState> states = renderer.readStates();
  const std::vector<gpu::ScreenBox> boxes = renderer.readBoxes();
  bool isCoarser = false;
  for (const ObjectFigures& object : figuresOf(renderer, scene, error, reference, 10).rows) {
    const std::uint32_t level = states[object.object].lod;
    EXPECT_EQ(object.level, level);
    EXPECT_EQ(object.triangles, scene.lods[level].triangleCount);
    EXPECT_FLOAT_EQ(static_cast<float>(object.allowed.value()), 0.5F);
    EXPECT_LE(object.errorPixels.value(), 0.5);
    EXPECT_FLOAT_EQ(static_cast<float>(*object.errorPixels),
                    scene.lods[level].errorObject * boxes[object.object].pixelsPerUnit);
    ASSERT_EQ(object.finer.has_value(), level > 0);
    if (!object.finer) continue;
    isCoarser = true;
    EXPECT_EQ(object.finer->triangles + object.triangles, scene.lods[level - 1].triangleCount);
    EXPECT_LT(object.finer->errorPixels.value(), *object.errorPixels);
  }
  EXPECT_TRUE(isCoarser);
  renderer.render(finest(), camera(), camera());
  for (const ObjectFigures& object : figuresOf(renderer, scene, error, reference, 10).rows) {
    EXPECT_EQ(object.level, 0U);
    EXPECT_FALSE(object.allowed.has_value()) << "the rule has no limit";
    EXPECT_FALSE(object.finer.has_value());
  }
}

TEST_F(ObjectFiguresTest, WhatAFrameLeavesOutIsListedWithItsError) {
  const scene::SceneData scene = scene::buildScene(file());
  render::FrameRenderer renderer(scene, kWidth, kHeight);
  const std::vector<std::uint32_t> reference = idsOf(renderer, finest());
  const auto missing = static_cast<double>(std::count(reference.begin(), reference.end(), 3U));
  ASSERT_GT(missing, 0.0);
  render::FrameOptions careless = finest();
  careless.minPixels = 100.0F;
  renderer.render(careless, camera(), camera());
  const ObjectsSample sample = figuresOf(renderer, scene, std::vector<float>(reference.size(), 1.0F), reference, 10);
  const auto lost = std::find_if(sample.rows.begin(), sample.rows.end(), [](const auto& o) { return o.object == 2; });
  ASSERT_NE(lost, sample.rows.end());
  EXPECT_FALSE(lost->drawn);
  EXPECT_EQ(lost->pixels, 0U);
  EXPECT_EQ(lost->flip, missing) << "its pixels in the reference";
  EXPECT_FALSE(lost->errorPixels.has_value());
}

TEST_F(ObjectFiguresTest, TheErrorMapStartsAtTheTopAndTheListIsCut) {
  const scene::SceneData scene = scene::buildScene(file());
  render::FrameRenderer renderer(scene, kWidth, kHeight);
  const std::vector<std::uint32_t> ids = idsOf(renderer, finest());
  // An error at one pixel of the small sphere alone, above the middle.
  const auto last = std::find(ids.rbegin(), ids.rend(), 2U);
  const auto pixel = static_cast<std::size_t>(ids.rend() - last) - 1;
  const std::size_t row = pixel / kWidth;
  ASSERT_GT(row, kHeight / 2);
  std::vector<float> error(ids.size());
  error[(kHeight - 1 - row) * kWidth + pixel % kWidth] = 0.75F;
  const ObjectsSample sample = figuresOf(renderer, scene, error, ids, 1);
  ASSERT_EQ(sample.rows.size(), 1U);
  EXPECT_EQ(sample.listed, 3U);
  EXPECT_EQ(sample.rows[0].object, 1U);
  EXPECT_EQ(sample.rows[0].flip, 0.75);
}

TEST_F(ObjectFiguresTest, AnObjectAtItsFinestLevelIsNotBlamedForWhatIsMissingBeforeIt) {
  const scene::SceneData scene = scene::buildScene(file());
  render::FrameRenderer renderer(scene, kWidth, kHeight);
  const std::vector<std::uint32_t> ids = idsOf(renderer, finest());
  std::vector<std::uint32_t> reference = ids;  // in which the second sphere covers one more pixel, of the first
  const auto first = std::find(ids.begin(), ids.end(), 1U);
  const auto pixel = static_cast<std::size_t>(first - ids.begin());
  reference[pixel] = 2;
  std::vector<float> error(ids.size());
  error[(kHeight - 1 - pixel / kWidth) * kWidth + pixel % kWidth] = 1.0F;
  const ObjectsSample exact = figuresOf(renderer, scene, error, reference, 10);
  EXPECT_EQ(exact.rows[0].object, 1U);
  EXPECT_EQ(exact.rows[0].flip, 1.0);
  renderer.render(pixelError(1000.0F), camera(), camera());
  ASSERT_GT(renderer.readStates()[0].lod, 0U);
  renderer.renderIds();
  if (renderer.readIds()[pixel] != 1) return;  // the coarse sphere does not reach the pixel
  EXPECT_EQ(figuresOf(renderer, scene, error, reference, 10).rows[0].object, 0U) << "a coarse one may bulge";
}

TEST_F(ObjectFiguresTest, PatchesHaveTheirTessellation) {
  const scene::SceneData scene = scene::buildScene(file(), {.patches = true});
  render::FrameRenderer renderer(scene, kWidth, kHeight);
  const std::vector<std::uint32_t> reference = idsOf(renderer, finest());
  render::FrameOptions options = pixelError(0.05F);
  options.detail = Detail::kTessellation;
  renderer.render(options, camera(), camera());
  const ObjectsSample sample = figuresOf(renderer, scene, std::vector<float>(reference.size(), 1.0F), reference, 10);
  ASSERT_FALSE(sample.rows.empty());
  const ObjectFigures& large = sample.rows[0];
  EXPECT_GT(large.tessellation, 1U);
  EXPECT_GT(large.triangles, scene.lods[scene.chains[0].patchLod].triangleCount);
  ASSERT_TRUE(large.finer.has_value());
  EXPECT_GT(large.finer->triangles, 0U);
  EXPECT_LT(large.finer->errorPixels.value(), large.errorPixels.value());
}

}  // namespace
}  // namespace jalousie::compare
