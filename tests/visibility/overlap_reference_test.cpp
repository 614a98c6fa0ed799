// Addressing and verdicts of the overlap test (thesis 3.4).
#include "visibility/overlap_reference.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"
#include "policy/lod_rule.h"
#include "shared/limits.h"

namespace jalousie::visibility {
namespace {

std::vector<float> filled(std::uint32_t width, std::uint32_t height, float open) {
  return std::vector<float>(std::size_t{width} * height, open);
}

gpu::ScreenBox boxOf(const glm::vec4& rect, float nearestDepth = 0.5F) {
  return {rect.x, rect.y, rect.z, rect.w, nearestDepth, 1.0F, 1.0F, 0};
}

TEST(Overlap, LevelIsTheCeilingOfTheLogarithm) {
  EXPECT_EQ(levelForExtent(0.0F), 0U);
  EXPECT_EQ(levelForExtent(1.0F), 0U);
  EXPECT_EQ(levelForExtent(1.001F), 1U);
  EXPECT_EQ(levelForExtent(2.0F), 1U);
  EXPECT_EQ(levelForExtent(16.0F), 4U);
  EXPECT_EQ(levelForExtent(17.0F), 5U);
  EXPECT_EQ(levelForExtent(1280.0F), 11U);
}

TEST(Overlap, RectangleTouchesAtMostTwoTexelsEachWayAtItsLevel) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const float x = random.uniform(0.0F, 1200.0F);
    const float y = random.uniform(0.0F, 700.0F);
    const glm::vec4 rect{x, y, std::min(1280.0F, x + random.uniform(0.0F, 600.0F)),
                         std::min(720.0F, y + random.uniform(0.0F, 300.0F))};
    const std::uint32_t lom = levelForExtent(std::max(rect.z - rect.x, rect.w - rect.y));
    const TexelRange texels = touchedPixels(rect, 1280, 720).atLevel(lom);
    ASSERT_LE(texels.lastX - texels.firstX, 1U);
    ASSERT_LE(texels.lastY - texels.firstY, 1U);
  }
}

TEST(Overlap, BlockHasEightToSixteenTexelsOnItsLongerSide) {
  const OcclusionMapReference map(mapLayout(1280, 720), filled(1280, 720, 1.0F));
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const float width = random.uniform(16.0F, 900.0F);
    const float height = random.uniform(0.5F, 700.0F);
    const float x = random.uniform(0.0F, 1280.0F - width);
    const float y = random.uniform(0.0F, 720.0F - height);
    const AnalysedBlock block = analysedBlock({&map, nullptr}, boxOf({x, y, x + width, y + height}));
    const std::uint32_t longer = std::max(block.x.count, block.y.count);
    ASSERT_GE(longer, 8U) << width << " x " << height;
    ASSERT_LE(longer, gpu::kMaxBlockSide);
    ASSERT_EQ(block.opacity.size(), std::size_t{block.x.count} * block.y.count);
  }
}

TEST(Overlap, CoveredIsCulledOpenIsOpen) {
  const glm::vec4 rect{100.3F, 50.2F, 161.7F, 99.9F};
  const OcclusionMapReference covered(mapLayout(333, 197), filled(333, 197, 0.0F));
  EXPECT_EQ(testOverlap({&covered, nullptr}, boxOf(rect), 1.0F).verdict, gpu::kVerdictOccluded);
  const OcclusionMapReference open(mapLayout(333, 197), filled(333, 197, 1.0F));
  EXPECT_EQ(testOverlap({&open, nullptr}, boxOf(rect), 1.0F).verdict, gpu::kVerdictOpen);
  EXPECT_EQ(testOverlap({&open, nullptr}, boxOf(rect), 1.0F).lv, -1.0F);
}

TEST(Overlap, OnePixelHoleInsideTheRectangleKeepsTheObject) {
  std::vector<float> pixels = filled(640, 360, 0.0F);
  pixels[std::size_t{200} * 640 + 300] = 1.0F;
  const OcclusionMapReference map(mapLayout(640, 360), pixels);
  EXPECT_EQ(testOverlap({&map, nullptr}, boxOf({290.0F, 190.0F, 310.0F, 210.0F}), 1.0F).verdict, gpu::kVerdictPartial);
  EXPECT_EQ(testOverlap({&map, nullptr}, boxOf({300.0F, 200.0F, 301.0F, 201.0F}), 1.0F).verdict, gpu::kVerdictOpen);
  EXPECT_EQ(testOverlap({&map, nullptr}, boxOf({10.0F, 10.0F, 31.0F, 31.0F}), 1.0F).verdict, gpu::kVerdictOccluded);
}

TEST(Overlap, DescentCullsWhatOnlyALooseTexelWouldKeep) {
  // Covered left of x = 40; the rectangle ends at 39 but its texel at LOM (32 wide: 32..63) reaches into the open.
  std::vector<float> pixels = filled(128, 64, 0.0F);
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 40; x < 128; ++x)
      pixels[std::size_t{y} * 128 + x] = 1.0F;
  const OcclusionMapReference map(mapLayout(128, 64), pixels);
  EXPECT_EQ(testOverlap({&map, nullptr}, boxOf({8.0F, 8.0F, 39.0F, 30.0F}), 1.0F).verdict, gpu::kVerdictOccluded);
}

TEST(Overlap, LowerThresholdCullsMore) {
  std::vector<float> pixels = filled(256, 256, 0.0F);
  for (std::size_t i = 0; i < pixels.size(); i += 64)
    pixels[i] = 1.0F;
  const OcclusionMapReference map(mapLayout(256, 256), pixels);
  const glm::vec4 rect{0.0F, 0.0F, 256.0F, 256.0F};
  EXPECT_EQ(testOverlap({&map, nullptr}, boxOf(rect), 1.0F).verdict, gpu::kVerdictPartial);
  EXPECT_EQ(testOverlap({&map, nullptr}, boxOf(rect), 0.95F).verdict, gpu::kVerdictOccluded);
}

TEST(Overlap, CullingIsConservativeAgainstEveryPixel) {
  // A culled rectangle must not contain one open pixel, whatever its place, size or the screen's size.
  Random random(9);
  std::vector<float> pixels = filled(201, 117, 0.0F);
  for (float& pixel : pixels)
    pixel = random.below(400) == 0 ? 1.0F : 0.0F;
  const OcclusionMapReference map(mapLayout(201, 117), pixels);
  int culled = 0;
  for (int i = 0; i < 20000; ++i) {
    const float x = random.uniform(0.0F, 200.0F);
    const float y = random.uniform(0.0F, 116.0F);
    const glm::vec4 rect{x, y, std::min(201.0F, x + random.uniform(0.0F, 40.0F)),
                         std::min(117.0F, y + random.uniform(0.0F, 40.0F))};
    if (testOverlap({&map, nullptr}, boxOf(rect), 1.0F).verdict != gpu::kVerdictOccluded) continue;
    ++culled;
    const TexelRange range = touchedPixels(rect, 201, 117);
    for (std::uint32_t py = range.firstY; py <= range.lastY; ++py)
      for (std::uint32_t px = range.firstX; px <= range.lastX; ++px)
        ASSERT_EQ(pixels[std::size_t{py} * 201 + px], 0.0F);
  }
  EXPECT_GT(culled, 1000);
}

TEST(Overlap, DepthHidesOnlyWhatLiesBehindIt) {
  const DepthPyramidReference wall(mapLayout(100, 60), filled(100, 60, 0.4F), false);
  const Cover cover{nullptr, &wall};
  const glm::vec4 rect(10, 10, 50, 40);
  EXPECT_EQ(testOverlap(cover, boxOf(rect, 0.3F), 1.0F).verdict, gpu::kVerdictOccluded);
  EXPECT_EQ(testOverlap(cover, boxOf(rect, 0.5F), 1.0F).verdict, gpu::kVerdictOpen);
  EXPECT_EQ(testOverlap(cover, boxOf(rect, 0.4F), 1.0F).verdict, gpu::kVerdictOpen) << "equal depth hides nothing";
}

TEST(Overlap, DepthCullingIsConservativeAgainstEveryPixel) {
  Random random(12);
  std::vector<float> depth = filled(201, 117, 0.0F);
  for (std::uint32_t y = 0; y < 117; ++y)
    for (std::uint32_t x = 0; x < 201; ++x)
      depth[std::size_t{y} * 201 + x] =
          random.below(600) == 0 ? 0.0F : 0.3F + 0.002F * static_cast<float>(x) + (y < 60 ? 0.2F : 0.0F);
  const DepthPyramidReference pyramid(mapLayout(201, 117), depth, false);
  int culled = 0;
  for (int i = 0; i < 20000; ++i) {
    const float x = random.uniform(0.0F, 200.0F);
    const float y = random.uniform(0.0F, 116.0F);
    const glm::vec4 rect{x, y, std::min(201.0F, x + random.uniform(0.0F, 40.0F)),
                         std::min(117.0F, y + random.uniform(0.0F, 40.0F))};
    const float nearest = random.uniform(0.1F, 0.9F);
    if (testOverlap({nullptr, &pyramid}, boxOf(rect, nearest), 1.0F).verdict != gpu::kVerdictOccluded) continue;
    ++culled;
    const TexelRange range = touchedPixels(rect, 201, 117);
    for (std::uint32_t py = range.firstY; py <= range.lastY; ++py)
      for (std::uint32_t px = range.firstX; px <= range.lastX; ++px)
        ASSERT_GT(depth[std::size_t{py} * 201 + px], nearest);
  }
  EXPECT_GT(culled, 1000);
}

TEST(Overlap, MapWithDepthCoversOnlyWhereOccludersAreInFront) {
  // Left half covered at depth 0.6, right half open.
  std::vector<float> open = filled(64, 64, 0.0F);
  std::vector<float> depth = filled(64, 64, 0.6F);
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 32; x < 64; ++x) {
      open[std::size_t{y} * 64 + x] = 1.0F;
      depth[std::size_t{y} * 64 + x] = 0.0F;
    }
  const OcclusionMapReference map(mapLayout(64, 64), open);
  const DepthPyramidReference pyramid(mapLayout(64, 64), depth, true);
  const Cover cover{&map, &pyramid};
  EXPECT_EQ(testOverlap(cover, boxOf({4, 4, 28, 60}, 0.5F), 1.0F).verdict, gpu::kVerdictOccluded);
  EXPECT_EQ(testOverlap(cover, boxOf({4, 4, 28, 60}, 0.7F), 1.0F).verdict, gpu::kVerdictOpen);
  EXPECT_EQ(testOverlap(cover, boxOf({4, 4, 60, 60}, 0.5F), 1.0F).verdict, gpu::kVerdictPartial);
  EXPECT_EQ(testOverlap(cover, boxOf({36, 4, 60, 60}, 0.5F), 1.0F).verdict, gpu::kVerdictOpen);
  EXPECT_EQ(testOverlap(cover, boxOf({4, 4, 31, 60}, 0.5F), 1.0F, 2.0F).verdict, gpu::kVerdictPartial)
      << "the guard reaches into the open";
}

TEST(Overlap, MarksRememberWhatWasSeen) {
  gpu::CullView view{};
  view.traits = traitsOf(LodRule::kLinear);
  view.maxTessellation = 20;
  scene::SceneData scene;
  scene.lods.resize(5);
  gpu::Chain chain{};
  chain.lodCount = 5;
  const gpu::ScreenBox box = boxOf({0, 0, 9, 9});
  const OverlapResult hidden{gpu::kVerdictOccluded, 1.0F};
  const OverlapResult partial{gpu::kVerdictPartial, 0.9F};
  gpu::ObjectState state{gpu::kVerdictPending, 0, 20, -1.0F};
  gpu::uint marks = gpu::kMarkEarly | gpu::kMarkVisible;
  applyOverlap(hidden, scene, view, chain, box, state, marks);
  EXPECT_EQ(state.verdict, gpu::kVerdictStale);
  EXPECT_EQ(marks, gpu::kMarkEarly) << "drawn now, not early in the next frame";
  state.verdict = gpu::kVerdictPending;
  marks = 0;
  applyOverlap(partial, scene, view, chain, box, state, marks);
  EXPECT_EQ(marks, gpu::kMarkLate | gpu::kMarkVisible);
  EXPECT_GT(state.lod, 0U) << "what is drawn late follows this frame's LV";
  marks = gpu::kMarkEarly | gpu::kMarkVisible;
  state = {gpu::kVerdictPending, 0, 20, -1.0F};
  applyOverlap(partial, scene, view, chain, box, state, marks);
  EXPECT_EQ(state.lod, 0U) << "already drawn: the new LV counts from the next frame on";
  EXPECT_FLOAT_EQ(state.lv, 0.9F);
}

}  // namespace
}  // namespace jalousie::visibility
