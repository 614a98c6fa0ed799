// The pictures of the modes with occlusion queries against those without culling.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "gl/buffer.h"
#include "render/methods/method_fixture.h"
#include "visibility/importance_mask.h"

namespace jalousie::render {
namespace {

std::vector<CullMode> queryModes() {
  std::vector<CullMode> modes;
  for (const CullModeRow& row : cullModeTable())
    if (row.asksQueries) modes.push_back(row.id);
  return modes;
}

void upload(gl::Buffer& buffer, const auto& values) {
  buffer.write(0, std::as_bytes(std::span(values)));
}

class QueriesGl : public MethodGl {};

TEST_F(QueriesGl, RulesAndDetailPathsGiveThePictureWithoutCulling) {
  const scene::SceneData scene = scene::buildScene(test::leafCards(40, 200, 3), {.patches = true});
  const auto camera = test::tour(scene, 3, 4);
  for (const CullMode mode : queryModes()) {
    for (const LodRule rule : {LodRule::kFinest, LodRule::kPixelError}) {
      for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
        FrameOptions frameOptions = options(mode);
        frameOptions.lodRule = rule;
        frameOptions.detail = detail;
        FrameOptions full = frameOptions;
        full.cullMode = CullMode::kFull;
        FrameRenderer renderer(scene, 160, 90);
        FrameRenderer everything(scene, 160, 90);
        for (std::uint32_t frame = 0; frame < 8; ++frame) {
          renderer.render(frameOptions, camera(frame), camera(frame));
          everything.render(full, camera(frame), camera(frame));
          ASSERT_EQ(renderer.readImage().pixels, everything.readImage().pixels)
              << rowOf(mode).name << " " << rowOf(rule).name << " frame " << frame;
        }
      }
    }
  }
}

TEST_F(QueriesGl, AFrozenCullingCameraIsShownFromOutside) {
  const scene::Camera other = scene::lookAt({7, 1, 0}, {0, 0, 0.5F}, scene_.boundsWorld);
  for (const CullMode mode : queryModes()) {
    FrameRenderer frozen(scene_, kMethodWidth, kMethodHeight);
    FrameRenderer usual(scene_, kMethodWidth, kMethodHeight);
    for (int frame = 0; frame < 3; ++frame) {
      frozen.render(options(mode), camera_, other);
      usual.render(options(mode), camera_, camera_);
    }
    const FrameStatistics statistics = frozen.readStatistics();
    EXPECT_EQ(statistics.drawn, usual.readStatistics().drawn) << rowOf(mode).name;
    EXPECT_GT(statistics.culledOcclusion, 0U);
    EXPECT_NE(frozen.readImage().pixels, usual.readImage().pixels);
  }
}

TEST_F(QueriesGl, TwoRunsGiveTheSameBits) {
  const auto camera = test::tour(scene_, 3, 9);
  for (const CullMode mode : queryModes()) {
    FrameRenderer first(scene_, 160, 90);
    FrameRenderer second(scene_, 160, 90);
    for (std::uint32_t frame = 0; frame < 8; ++frame) {
      first.render(options(mode), camera(frame), camera(frame));
      second.render(options(mode), camera(frame), camera(frame));
      const FrameStatistics a = first.readStatistics();
      const FrameStatistics b = second.readStatistics();
      EXPECT_EQ(first.readMarks(), second.readMarks()) << rowOf(mode).name;
      EXPECT_EQ(a.queries, b.queries) << rowOf(mode).name;
      EXPECT_EQ(a.queryBoxes, b.queryBoxes) << rowOf(mode).name;
      EXPECT_EQ(first.readImage().pixels, second.readImage().pixels) << rowOf(mode).name;
    }
  }
}

TEST_F(QueriesGl, AThresholdLeavesOutMore) {
  for (const CullModeRow& row : cullModeTable()) {
    if (!row.countsSamples) continue;
    FrameOptions tolerant = options(row.id);
    tolerant.queries.threshold = 200;
    FrameRenderer renderer(scene_, kMethodWidth, kMethodHeight);
    const std::uint64_t exact = settle(renderer, row.id).drawn;
    for (int frame = 0; frame < 3; ++frame)
      renderer.render(tolerant, camera_, camera_);
    EXPECT_LT(renderer.readStatistics().drawn, exact) << row.name;
  }
}

TEST_F(QueriesGl, SamplesOutsideOfTheImportantRegionDoNotCount) {
  ImageRgba8 grey{8, 8, std::vector<std::uint8_t>(8 * 8 * 4, 255)};
  for (std::size_t texel = 0; texel < 64; ++texel)
    if (texel % 8 < 4) std::fill_n(&grey.pixels[4 * texel], 3, std::uint8_t{20});  // the left half
  const visibility::ImportanceMask mask(grey);
  FrameRenderer everything(scene_, kMethodWidth, kMethodHeight);
  everything.render(options(CullMode::kFull), camera_, camera_);
  const std::vector<std::uint8_t> expected = everything.readImage().pixels;
  for (const CullMode mode : queryModes()) {
    FrameOptions frameOptions = options(mode);
    FrameRenderer renderer(scene_, kMethodWidth, kMethodHeight, {.importance = &mask});
    renderer.render(frameOptions, camera_, camera_);
    const std::uint64_t all = renderer.readStatistics().drawn;
    frameOptions.queries.importance = 0.5F;
    for (int frame = 0; frame < 3; ++frame)
      renderer.render(frameOptions, camera_, camera_);
    EXPECT_LT(renderer.readStatistics().drawn, all) << rowOf(mode).name;
    const std::vector<std::uint8_t> pixels = renderer.readImage().pixels;
    for (std::size_t y = 0; y < kMethodHeight; ++y) {
      const std::size_t first = 4 * (y * kMethodWidth + kMethodWidth / 2);
      const auto row = pixels.begin() + static_cast<std::ptrdiff_t>(first);
      ASSERT_TRUE(std::equal(row, row + 2 * kMethodWidth, expected.begin() + static_cast<std::ptrdiff_t>(first)))
          << rowOf(mode).name << ": row " << y << " of the important half";
    }
  }
}

/// The texture of a mask has sides that are powers of two, and is larger than this one.
TEST_F(QueriesGl, AWhiteMaskChangesNothing) {
  const visibility::ImportanceMask mask(ImageRgba8{16, 9, std::vector<std::uint8_t>(16 * 9 * 4, 255)});
  for (const CullMode mode : queryModes()) {
    FrameOptions frameOptions = options(mode);
    FrameRenderer without(scene_, kMethodWidth, kMethodHeight);
    FrameRenderer with(scene_, kMethodWidth, kMethodHeight, {.importance = &mask});
    without.render(frameOptions, camera_, camera_);
    frameOptions.queries.importance = 1.0F;
    with.render(frameOptions, camera_, camera_);
    EXPECT_EQ(with.readStatistics().drawn, without.readStatistics().drawn) << rowOf(mode).name;
    EXPECT_EQ(with.readImage().pixels, without.readImage().pixels) << rowOf(mode).name;
  }
}

TEST_F(QueriesGl, OptionsChangeCountsAndNeverThePicture) {
  FrameRenderer everything(scene_, 160, 90);
  everything.render(options(CullMode::kFull), camera_, camera_);
  const std::vector<std::uint8_t> expected = everything.readImage().pixels;
  Random random(2);
  for (const CullMode mode : queryModes()) {
    FrameRenderer renderer(scene_, 160, 90);
    for (int trial = 0; trial < 6; ++trial) {
      FrameOptions frameOptions = options(mode);
      frameOptions.queries.batch = 1 + random.below(100);
      frameOptions.queries.multiquery = static_cast<culling::Multiquery>(random.below(3));
      frameOptions.queries.tightBounds = random.below(2) == 0 ? 0.0F : 1.4F;
      frameOptions.queries.requery = random.below(8);
      frameOptions.queries.planeDepth = random.below(6);
      frameOptions.queries.unitsTogether = random.below(2) == 0;
      renderer.render(frameOptions, camera_, camera_);
      EXPECT_EQ(renderer.readImage().pixels, expected) << rowOf(mode).name << " trial " << trial;
    }
  }
}

TEST_F(QueriesGl, TransformsThatAShaderMayWriteAreFollowed) {
  for (const CullMode mode : queryModes()) {
    FrameRenderer renderer(scene_, 160, 90);
    FrameRenderer everything(scene_, 160, 90);
    std::vector<gpu::Transform> transforms = scene_.transforms;
    const auto move = test::swingObjects(scene_, 2);
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
      move(frame, transforms);
      upload(renderer.transforms(), transforms);
      upload(everything.transforms(), transforms);
      renderer.render(options(mode), camera_, camera_);
      everything.render(options(CullMode::kFull), camera_, camera_);
      EXPECT_EQ(renderer.readImage().pixels, everything.readImage().pixels) << rowOf(mode).name << " " << frame;
    }
  }
}

}  // namespace
}  // namespace jalousie::render
