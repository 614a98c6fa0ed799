// Counting of verdicts into figures.
#include "render/frame_statistics.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/scenes.h"

namespace jalousie::render {
namespace {

TEST(FrameStatistics, CountsVerdictsLevelsAndTriangles) {
  asset::SceneFile file = test::sphereChain(3);
  for (int i = 0; i < 5; ++i)
    test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  const scene::SceneData scene = scene::buildScene(file);
  gpu::CullView view{};
  view.detail = gpu::kDetailDiscrete;
  const std::vector<gpu::ObjectState> states = {{gpu::kVerdictOutside, 0, 20, -1},
                                                {gpu::kVerdictOccluded, 0, 20, 1},
                                                {gpu::kVerdictOccluder, 0, 20, -1},
                                                {gpu::kVerdictPartial, 2, 5, 0.4F},
                                                {gpu::kVerdictNear, 0, 20, -1}};
  const FrameStatistics s = countFrame(scene, view, states);
  EXPECT_EQ(s.objects, 5U);
  EXPECT_EQ(s.culledFrustum, 1U);
  EXPECT_EQ(s.culledOcclusion, 1U);
  EXPECT_EQ(s.occluders, 1U);
  EXPECT_EQ(s.drawn, 3U);
  EXPECT_EQ(s.lodHistogram, (std::vector<std::uint64_t>{2, 0, 1}));
  EXPECT_EQ(s.triangles, 2ULL * scene.lods[0].triangleCount + scene.lods[2].triangleCount);
  EXPECT_EQ(s.trianglesFull, 5ULL * scene.lods[0].triangleCount);
}

TEST(FrameStatistics, TessellationCountsThesisNumbers) {
  asset::SceneFile file = test::sphereChain(1);
  file.meshes[0].primitives = {test::sphere(7, 8)};  // 98 triangles, as the thesis' bunny
  for (int i = 0; i < 5001; ++i)
    test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  const scene::SceneData scene = scene::buildScene(file, {.patches = true});
  gpu::CullView view{};
  view.detail = gpu::kDetailTessellation;
  view.maxTessellation = 20;
  const std::vector<gpu::ObjectState> states(5001, {gpu::kVerdictOccluder, 0, 20, -1});
  const FrameStatistics s = countFrame(scene, view, states);
  EXPECT_EQ(s.trianglesFull, 294058800ULL);  // thesis 4.2.1
  EXPECT_EQ(s.triangles, 294058800ULL);
  ASSERT_EQ(s.lodHistogram.size(), 20U);
  EXPECT_EQ(s.lodHistogram.back(), 5001U);
}

TEST(FrameStatistics, EmptySceneCountsNothing) {
  const FrameStatistics s = countFrame({}, {}, {});
  EXPECT_EQ(s.objects + s.drawn + s.triangles + s.trianglesFull, 0U);
}

}  // namespace
}  // namespace jalousie::render
