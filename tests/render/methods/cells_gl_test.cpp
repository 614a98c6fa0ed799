// Cells that are culled one by one change no pixel, in any mode, at any level rule, along moving cameras, and save
// triangles.
#include <gtest/gtest.h>

#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "support/culling.h"
#include "support/gl_test.h"
#include "support/scenes.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 180;
constexpr scene::CellOptions kCells{scene::CellOptions::Kind::kCount, 24};

/// Spheres within, before and behind each other, some around the camera's places.
asset::SceneFile crowd() {
  asset::SceneFile file = test::randomSpheres(60, 4.0F, 31);
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(3.0F));
  test::addInstance(file, 0, {0, 0, 9}, {-6.0F, 2.0F, 1.0F});
  return file;
}

class CellsGl : public test::GlTest {
 protected:
  static scene::SceneData divided(const asset::SceneFile& file) { return scene::buildScene(file, {.cells = kCells}); }
};

TEST_F(CellsGl, PicturesEqualThoseOfWholeObjects) {
  const asset::SceneFile file = crowd();
  const scene::SceneData whole = scene::buildScene(file);
  const scene::SceneData cells = divided(file);
  const auto camera = test::tour(whole, 4, 9);
  for (const CullModeRow& mode : cullModeTable()) {
    for (const LodRuleRow& rule : lodRuleTable()) {
      SCOPED_TRACE(testing::Message() << mode.name << ' ' << rule.name);
      FrameOptions options;
      options.cullMode = mode.id;
      options.lodRule = rule.id;
      options.lvMeasure = rule.measure;
      options.calm = rule.followsError;
      if (wantsBlock(options) && !mode.testsOcclusion) continue;
      // Two phases: a block of the depth pyramid shows what the first phase drew, which differs. Objects that were not
      // counted yet take their LV from it, too.
      if (rule.followsLv && mode.twoPhases) continue;
      FrameRenderer first(whole, kWidth, kHeight);
      FrameRenderer second(cells, kWidth, kHeight);
      std::uint64_t triangles[2] = {};
      for (std::uint32_t frame = 0; frame < 16; ++frame) {
        first.render(options, camera(frame), camera(frame));
        second.render(options, camera(frame), camera(frame));
        ASSERT_EQ(first.readImage().pixels, second.readImage().pixels) << "frame " << frame;
        ASSERT_EQ(first.readDepth(), second.readDepth()) << "frame " << frame;
        triangles[0] += first.readStatistics().triangles;
        triangles[1] += second.readStatistics().triangles;
      }
      EXPECT_EQ(triangles[1] < triangles[0], mode.culls);
    }
  }
}

TEST_F(CellsGl, SettledPicturesEqualThoseOfWholeObjectsWhereLevelsFollowCounts) {
  const asset::SceneFile file = crowd();
  const scene::SceneData whole = scene::buildScene(file);
  const scene::SceneData cells = divided(file);
  const auto camera = test::tour(whole, 1, 9);
  for (const LodRuleRow& rule : lodRuleTable()) {
    if (rule.measure != LvMeasure::kPixels) continue;
    FrameOptions options;
    options.lodRule = rule.id;
    options.lvMeasure = rule.measure;
    FrameRenderer first(whole, kWidth, kHeight);
    FrameRenderer second(cells, kWidth, kHeight);
    for (std::uint32_t place = 0; place < 4; ++place) {
      for (std::uint32_t frame = 0; frame < 4 * kCountInterval; ++frame) {
        first.render(options, camera(place), camera(place));
        second.render(options, camera(place), camera(place));
      }
      EXPECT_EQ(first.readImage().pixels == second.readImage().pixels, true) << rule.name << " at place " << place;
      EXPECT_LT(second.readStatistics().triangles, first.readStatistics().triangles);
    }
  }
}

TEST_F(CellsGl, NoPixelIsLostAlongPaths) {
  const test::Journey journey{"crowd", divided(crowd()), {}, {}};
  test::Journey moving{"moving crowd", divided(crowd()), {}, test::swingObjects(journey.scene, 3)};
  moving.camera = test::tour(journey.scene, 6, 5);
  for (const CullModeRow& mode : cullModeTable()) {
    if (!mode.conservative) continue;
    FrameOptions options = test::pixelErrorOptions();
    options.cullMode = mode.id;
    const test::CullingLoss loss = test::countLoss(moving, kWidth, kHeight, options, 0, 24);
    EXPECT_EQ(loss.wrongPixels, 0U) << mode.name;
    EXPECT_EQ(loss.differentDepths, 0U) << mode.name;
  }
}

TEST_F(CellsGl, StatisticsCountObjectsAndCells) {
  const asset::SceneFile file = crowd();
  const scene::SceneData cells = divided(file);
  FrameRenderer renderer(cells, kWidth, kHeight);
  const scene::Camera camera = scene::lookAt({0, 0, 7}, {0, 0, 0}, cells.boundsWorld);
  FrameOptions options = test::pixelErrorOptions();
  for (int frame = 0; frame < 3; ++frame)
    renderer.render(options, camera, camera);
  const FrameStatistics culled = renderer.readStatistics();
  EXPECT_EQ(culled.objects, file.instances.size());
  EXPECT_EQ(culled.cells, cells.cells.objects.size());
  EXPECT_GT(culled.cellsDrawn, culled.drawn);
  EXPECT_LT(culled.cellsDrawn, culled.cells);
  EXPECT_EQ(culled.dropped, 0U);
  options.cullCells = false;
  for (int frame = 0; frame < 3; ++frame)
    renderer.render(options, camera, camera);
  const FrameStatistics asWhole = renderer.readStatistics();
  const scene::SceneData undivided = scene::buildScene(file);
  FrameRenderer whole(undivided, kWidth, kHeight);
  for (int frame = 0; frame < 3; ++frame)
    whole.render(options, camera, camera);
  const FrameStatistics expected = whole.readStatistics();
  EXPECT_EQ(asWhole.triangles, expected.triangles);
  EXPECT_EQ(asWhole.drawn, expected.drawn);
  EXPECT_EQ(asWhole.lodHistogram, expected.lodHistogram);
  EXPECT_LT(culled.triangles, asWhole.triangles);
}

TEST_F(CellsGl, BothSubmissionsAndEveryViewDraw) {
  const scene::SceneData cells = divided(crowd());
  const scene::Camera camera = scene::lookAt({0, 0, 7}, {0, 0, 0}, cells.boundsWorld);
  for (const ViewRow& view : viewTable()) {
    std::vector<std::uint8_t> pictures[2];
    for (const bool perObject : {false, true}) {
      FrameRenderer renderer(
          cells, kWidth, kHeight,
          {.submission = perObject ? visibility::Submission::kPerObject : visibility::Submission::kInstanced});
      FrameOptions options = test::pixelErrorOptions();
      options.view = view.id;
      for (int frame = 0; frame < 3; ++frame)
        renderer.render(options, camera, camera);
      pictures[perObject ? 1 : 0] = renderer.readImage().pixels;
    }
    EXPECT_EQ(pictures[0], pictures[1]) << view.name;
  }
}

}  // namespace
}  // namespace jalousie::render
