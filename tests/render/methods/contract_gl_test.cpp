// Every row of the mode table holds what it says: a property of a mode that is not true fails here.
#include <gtest/gtest.h>

#include "render/methods/method_fixture.h"

namespace jalousie::render {
namespace {

class MethodContractGl : public MethodGl {};

TEST_F(MethodContractGl, FiguresAgreeWithTheRow) {
  for (const CullModeRow& row : cullModeTable()) {
    FrameRenderer renderer(scene_, kMethodWidth, kMethodHeight);
    const FrameStatistics statistics = settle(renderer, row.id);
    EXPECT_EQ(statistics.culledFrustum > 0, row.culls) << row.name;
    EXPECT_EQ(statistics.culledOcclusion > 0, row.testsOcclusion || row.asksQueries || row.castsShadows) << row.name;
    EXPECT_EQ(statistics.queries > 0, row.asksQueries) << row.name;
    EXPECT_EQ(statistics.shadows > 0, row.castsShadows) << row.name;
    EXPECT_EQ(statistics.queryWaits > 0, row.readsBack) << row.name;
    EXPECT_EQ(statistics.occluders > 0, row.usesMap) << row.name;
    EXPECT_EQ(statistics.drawnEarly > 0, row.twoPhases) << row.name;
    EXPECT_EQ(statistics.drawn + statistics.culledFrustum + statistics.culledOcclusion, statistics.objects) << row.name;
  }
}

TEST_F(MethodContractGl, OnlyConservativeModesLoseNoPixel) {
  // A large ground plane and small objects: an occlusion map without depth fails here.
  const test::Journey journey{"ground plane", scene::buildScene(test::groundPlane(150, 3)), {}, {}};
  const auto camera = test::tour(journey.scene, 6, 5);
  for (const CullModeRow& row : cullModeTable()) {
    test::Journey withCamera = journey;
    withCamera.camera = camera;
    const test::CullingLoss loss = test::countLoss(withCamera, kMethodWidth, kMethodHeight, options(row.id), 0, 24);
    EXPECT_EQ(loss.wrongPixels == 0, row.conservative) << row.name << ": " << loss.wrongPixels << " wrong pixels";
  }
}

TEST_F(MethodContractGl, OnlyModesWithHistoryDependOnTheFramesBefore) {
  for (const CullModeRow& row : cullModeTable()) {
    FrameRenderer renderer(scene_, kMethodWidth, kMethodHeight);
    const std::uint64_t first = settle(renderer, row.id, 1).drawn;
    const std::uint64_t settled = settle(renderer, row.id, 3).drawn;
    EXPECT_EQ(first != settled, row.needsHistory) << row.name << ": " << first << " and " << settled << " drawn";
    renderer.resetHistory();
    EXPECT_EQ(settle(renderer, row.id, 1).drawn, first) << row.name << " after its history is forgotten";
  }
}

TEST_F(MethodContractGl, ModesMayChangeFromFrameToFrame) {
  FrameRenderer mixed(scene_, kMethodWidth, kMethodHeight);
  for (int turn = 0; turn < 2; ++turn) {
    for (const CullModeRow& row : cullModeTable()) {
      FrameRenderer alone(scene_, kMethodWidth, kMethodHeight);
      settle(mixed, row.id);
      settle(alone, row.id);
      EXPECT_EQ(mixed.readImage().pixels, alone.readImage().pixels) << row.name;
    }
  }
}

TEST_F(MethodContractGl, CoverCanBeDrawnAgainAfterEveryMode) {
  for (const CullModeRow& row : cullModeTable()) {
    FrameRenderer renderer(scene_, kMethodWidth, kMethodHeight);
    settle(renderer, row.id);
    renderer.renderCover();
    const std::vector<float> once = renderer.readDepth();
    renderer.renderCover();
    EXPECT_EQ(renderer.readDepth(), once) << row.name;
  }
}

}  // namespace
}  // namespace jalousie::render
