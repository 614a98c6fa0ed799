// Counting of verdicts into figures.

#include <gtest/gtest.h>

#include <numeric>

#include "policy/frame_policy.h"
#include "render/make_statistics.h"
#include "support/scenes.h"

namespace jalousie::render {
namespace {

FrameStatistics count(const scene::SceneData& scene, gpu::CullView view, const std::vector<gpu::ObjectState>& states,
                      const std::vector<gpu::uint>& marks) {
  view.objectCount = static_cast<gpu::uint>(states.size());
  return makeStatistics(visibility::countStates(scene, view, states, marks), view, countFinestTriangles(scene));
}

TEST(FrameStatistics, CountsVerdictsLevelsPhasesAndTriangles) {
  asset::SceneFile file = test::sphereChain(3);
  for (int i = 0; i < 6; ++i)
    test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  const scene::SceneData scene = scene::buildScene(file);
  gpu::CullView view{};
  view.traits = traitsOf(CullMode::kHiz);
  const std::vector<gpu::ObjectState> states = {{gpu::kVerdictOutside, 0, 20, -1}, {gpu::kVerdictOccluded, 0, 20, 1},
                                                {gpu::kVerdictStale, 0, 20, -1},   {gpu::kVerdictPartial, 2, 5, 0.4F},
                                                {gpu::kVerdictNear, 0, 20, -1},    {gpu::kVerdictSmall, 0, 20, -1}};
  const std::vector<gpu::uint> marks = {0, 0, gpu::kMarkEarly, gpu::kMarkLate, gpu::kMarkEarly, 0};
  const FrameStatistics s = count(scene, view, states, marks);
  EXPECT_EQ(s.objects, 6U);
  EXPECT_EQ(s.culledFrustum, 1U);
  EXPECT_EQ(s.culledOcclusion, 1U);
  EXPECT_EQ(s.culledSmall, 1U);
  EXPECT_EQ(s.drawn, 3U);
  EXPECT_EQ(s.drawnEarly, 2U);
  EXPECT_EQ(s.drawnStale, 1U);
  EXPECT_EQ(s.dropped, 0U);
  EXPECT_EQ(s.lodHistogram, (std::vector<std::uint64_t>{2, 0, 1}));
  EXPECT_EQ(s.triangles, 2ULL * scene.lods[0].triangleCount + scene.lods[2].triangleCount);
  EXPECT_EQ(s.trianglesFinest, 6ULL * scene.lods[0].triangleCount);
}

TEST(FrameStatistics, OccludersAreCountedOnceThoughTheMapDrawsThemToo) {
  asset::SceneFile file = test::sphereChain(3);
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  const scene::SceneData scene = scene::buildScene(file);
  gpu::CullView view{};
  view.traits = traitsOf(CullMode::kHom);
  const FrameStatistics s =
      count(scene, view, {{gpu::kVerdictOccluder, 0, 20, -1}}, {gpu::kMarkEarly | gpu::kMarkLate});
  EXPECT_EQ(s.occluders, 1U);
  EXPECT_EQ(s.drawn, 1U);
  EXPECT_EQ(s.drawnEarly, 0U);
}

TEST(FrameStatistics, TessellationCountsThesisNumbers) {
  asset::SceneFile file = test::sphereChain(1);
  file.meshes[0].primitives = {test::sphere(7, 8)};  // 98 triangles, as the thesis' bunny
  for (int i = 0; i < 5001; ++i)
    test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  const scene::SceneData scene = scene::buildScene(file, {.patches = true});
  gpu::CullView view{};
  view.traits = traitsOf(Detail::kTessellation);
  view.maxTessellation = 20;
  const FrameStatistics s = count(scene, view, std::vector<gpu::ObjectState>(5001, {gpu::kVerdictPending, 0, 20, -1}),
                                  std::vector<gpu::uint>(5001, gpu::kMarkLate));
  EXPECT_EQ(s.trianglesFinest, 294058800ULL);  // thesis 4.2.1
  EXPECT_EQ(s.triangles, 294058800ULL);
  ASSERT_EQ(s.lodHistogram.size(), 20U);
  EXPECT_EQ(s.lodHistogram.back(), 5001U);
}

TEST(FrameStatistics, TrianglesBeyondFourBillionAreCounted) {
  visibility::FrameCounters counters = {};
  counters[gpu::kCounterTriangles + 0] = 4000000000U;
  counters[gpu::kCounterTriangles + 3] = 40;
  EXPECT_EQ(visibility::triangleSum(counters), 4000000000ULL + (40ULL << 30U));
}

TEST(FrameStatistics, EmptySceneCountsNothing) {
  const FrameStatistics s = makeStatistics({}, {}, {});
  EXPECT_EQ(s.objects + s.drawn + s.triangles + s.trianglesFinest, 0U);
}

}  // namespace
}  // namespace jalousie::render
