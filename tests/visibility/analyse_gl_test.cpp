// analyse.comp against its CPU twin, on random and adversarial input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <optional>
#include <vector>

#include "core/random.h"
#include "render/scene_buffers.h"
#include "shared/limits.h"
#include "support/gl_test.h"
#include "support/scenes.h"
#include "visibility/kernel_input.h"
#include "visibility/masking.h"
#include "visibility/overlap_reference.h"
#include "visibility/visibility_pass.h"

namespace jalousie::visibility {
namespace {

using scene::SceneData;

/// Boxes of every kind: tiny, huge, at the borders, degenerate, aligned and misaligned, at any depth.
std::vector<gpu::ScreenBox> adversarialBoxes(ScreenSize size, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  std::vector<glm::vec4> rects = {{0, 0, width, height},    {0, 0, 0, 0},         {width, height, width, height},
                                  {0.5F, 0.5F, 0.6F, 0.6F}, {0, 0, width, 0.25F}, {0, 0, 0.25F, height}};
  while (rects.size() < count) {
    const float scale = std::exp2(-random.uniform(0.0F, 9.0F));
    float x0 = random.uniform(0.0F, width);
    float y0 = random.uniform(0.0F, height);
    if (random.below(3) == 0) x0 = std::floor(x0 / 16.0F) * 16.0F;
    if (random.below(3) == 0) y0 = std::floor(y0);
    rects.emplace_back(x0, y0, std::min(width, x0 + random.uniform() * scale * width),
                       std::min(height, y0 + random.uniform() * scale * height));
  }
  std::vector<gpu::ScreenBox> boxes;
  boxes.reserve(rects.size());
  for (const glm::vec4& rect : rects)
    boxes.push_back(
        {rect.x, rect.y, rect.z, rect.w, random.below(9) == 0 ? 0.1F : random.uniform(0.05F, 0.7F), 1.0F, 1.0F, 0});
  return boxes;
}

SceneData sceneOfCount(std::size_t count) {
  asset::SceneFile file = test::sphereChain(5);
  for (std::size_t i = 0; i < count; ++i)
    test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  return scene::buildScene(file);
}

class AnalyseGl : public test::GlTest {
 protected:
  /// Runs the kernel of a mode on given boxes, some of them drawn early, and compares what it writes with the twin.
  static void compare(CullMode mode, std::size_t (&verdicts)[gpu::kVerdictCount],
                      LvMeasure measure = LvMeasure::kThesis, gpu::uint calm = 0) {
    constexpr std::size_t kCount = 1500;
    const SceneData scene = sceneOfCount(kCount);
    const render::SceneBuffers buffers(scene);
    ObjectStore objects(buffers.objectCount());
    VisibilityPass pass(objects);
    for (const ScreenSize size : kSizes) {
      for (const float threshold : {1.0F, 0.9F}) {
        const GivenMap map(size, structuredPixels(size, 7 + size.height));
        const GivenDepth depth(size, structuredDepth(size, 7 + size.height),
                               !rowOf(mode).usesMap ? DepthSource::kAll : DepthSource::kCovered, true);
        const Cover cover{!rowOf(mode).usesMap ? nullptr : &map.reference,
                          !rowOf(mode).usesDepth ? nullptr : &depth.reference};
        const std::vector<gpu::ScreenBox> boxes = adversarialBoxes(size, kCount, size.width);
        const LodRule rule = calm != 0 ? LodRule::kLvError : LodRule::kLinear;
        gpu::CullView view = makeView(scene, {}, size, 0.0F, {.cullMode = mode, .lodRule = rule, .lvMeasure = measure});
        view.cullThreshold = threshold;
        view.occluderTau = mode == CullMode::kHomDepth ? 0.5F : 0.0F;
        view.calm = calm;
        view.relax = 64.0F;
        pass.setView(view);
        const std::vector<gpu::ObjectState> states(kCount, {gpu::kVerdictPending, 3, 20, -0.5F});
        std::vector<gpu::uint> marks(kCount);
        for (std::size_t i = 0; i < kCount; i += 3)
          marks[i] = !rowOf(mode).usesMap ? gpu::kMarkEarly | gpu::kMarkVisible : 0;
        for (std::size_t i = 0; i < kCount; i += 2)
          marks[i] |= calm != 0 ? gpu::kMarkCalm | gpu::kMarkRemembered : 0;
        for (std::size_t i = 0; i < kCount; i += 5)
          marks[i] |= gpu::kMarkKnown | (i % 3 == 0 && measure == LvMeasure::kPixels ? gpu::kMarkCounted : 0) |
                      (i % 2 == 0 ? 3U << gpu::kMarkFadeShift : 0);
        objects.boxes.write(0, std::as_bytes(std::span(boxes)));
        objects.states.write(0, std::as_bytes(std::span(states)));
        objects.marks.write(0, std::as_bytes(std::span(marks)));
        pass.analyse(buffers.bindings(), view.traits, {&map.pass.texture(), &depth.pass.texture(), &depth.texture});
        const auto gpuStates = objects.states.read<gpu::ObjectState>(kCount);
        const auto gpuMarks = objects.marks.read<gpu::uint>(kCount);
        for (std::size_t i = 0; i < kCount; ++i) {
          const OverlapResult result =
              testOverlap(cover, boxes[i], threshold, mode == CullMode::kHomDepth ? 1.0F : 0.0F,
                          (marks[i] & gpu::kMarkCounted) != 0 ? std::nullopt : std::optional(view.traits));
          ObjectDecision expected{states[i], boxes[i], marks[i]};
          applyOverlap(result, scene, view, scene.chains[0], expected);
          ASSERT_EQ(gpuStates[i].verdict, expected.state.verdict) << size.width << "x" << size.height << " box " << i;
          ASSERT_NEAR(gpuStates[i].lv, expected.state.lv, measure == LvMeasure::kThesis ? 2e-5F : 2e-4F)
              << size.width << "x" << size.height << " box " << i << " measure " << rowOf(measure).name;
          ASSERT_EQ(gpuMarks[i], expected.marks) << size.width << "x" << size.height << " box " << i;
          ++verdicts[expected.state.verdict];
        }
      }
    }
  }
};

/// Whether two covers differ by no more than sums of floats and halves round. Endless chords are infinite in both.
bool isSameCover(gpu::uint actual, gpu::uint expected) {
  const glm::vec2 a = glm::unpackHalf2x16(actual);
  const glm::vec2 b = glm::unpackHalf2x16(expected);
  return std::abs(a.x - b.x) <= 2e-3F && (a.y == b.y || std::abs(a.y - b.y) <= 3e-3F * b.y);
}

/// What the kernel wrote for one object, against the twin. @param given  before the kernel
void expectSameMaskedLevel(const SceneData& scene, const gpu::CullView& view, const Cover& cover,
                           const ObjectDecision& given, const ObjectDecision& actual) {
  const bool occluded = actual.state.verdict == gpu::kVerdictOccluded;
  if (occluded) {
    ASSERT_EQ(actual.box.cover, given.box.cover) << "a block that nothing needs was measured";
  } else {
    ASSERT_TRUE(isSameCover(actual.box.cover, measuredCover(cover, given.box)));
  }
  const OverlapResult result{actual.state.verdict, actual.state.lv};
  std::vector<gpu::uint> plausible;  // levels for a factor within rounding
  for (const float scale : {0.999F, 1.0F, 1.001F}) {
    ObjectDecision expected = given;
    expected.box.cover = actual.box.cover;
    expected.box.pixelsPerUnit *= scale;
    applyOverlap(result, scene, view, scene.chains[0], expected);
    plausible.push_back(expected.state.lod);
  }
  EXPECT_NE(std::find(plausible.begin(), plausible.end(), actual.state.lod), plausible.end())
      << "level " << actual.state.lod << " for " << plausible[1];
}

/// Objects that an analysis finds pending, with sizes on the screen at which their levels change.
struct PendingObjects {
  explicit PendingObjects(const SceneData& scene, ScreenSize size)
      : states(scene.objects.size(), {gpu::kVerdictPending, 3, 20, -1.0F}),
        boxes(adversarialBoxes(size, scene.objects.size(), 17)) {
    Random random(5);
    for (gpu::ScreenBox& box : boxes) {
      box.pixelsPerUnit = random.uniform(0.1F, 6.0F) / scene.lods[scene.chains[0].firstLod + 1].errorObject;
      box.cover = gpu::kCoverOpen;
    }
  }
  std::vector<gpu::ObjectState> states;
  std::vector<gpu::ScreenBox> boxes;
};

TEST_F(AnalyseGl, MaskedErrorsEqualTheTwin) {
  constexpr std::size_t kCount = 1500;
  constexpr ScreenSize kSize{640, 360};
  const SceneData scene = sceneOfCount(kCount);
  const render::SceneBuffers buffers(scene);
  ObjectStore objects(buffers.objectCount());
  VisibilityPass pass(objects);
  const PendingObjects given(scene, kSize);
  for (const CullMode mode : {CullMode::kHom, CullMode::kHomDepth, CullMode::kHiz}) {
    const bool usesMap = rowOf(mode).usesMap;
    const GivenMap map(kSize, structuredPixels(kSize, 3));
    const GivenDepth depth(kSize, structuredDepth(kSize, 3), usesMap ? DepthSource::kCovered : DepthSource::kAll, true);
    const Cover cover{usesMap ? &map.reference : nullptr, rowOf(mode).usesDepth ? &depth.reference : nullptr};
    for (const LodRule rule : {LodRule::kPixelError, LodRule::kCoverage, LodRule::kLvError, LodRule::kPrice}) {
      const FramePolicy policy{.cullMode = mode, .lodRule = rule, .lvMeasure = LvMeasure::kCoverage, .masking = true};
      gpu::CullView view = makeView(scene, {}, kSize, 0.0F, policy);
      view.occluderTau = 0.0F;
      view.analyse = wantsBlock(policy) ? 1 : 0;
      pass.setView(view);
      objects.boxes.write(0, std::as_bytes(std::span(given.boxes)));
      objects.states.write(0, std::as_bytes(std::span(given.states)));
      objects.marks.clear();
      pass.analyse(buffers.bindings(), view.traits, {&map.pass.texture(), &depth.pass.texture(), &depth.texture});
      const auto gpuStates = objects.states.read<gpu::ObjectState>(kCount);
      const auto gpuBoxes = objects.boxes.read<gpu::ScreenBox>(kCount);
      std::size_t masked = 0;
      for (std::size_t i = 0; i < kCount; ++i) {
        SCOPED_TRACE(testing::Message() << rowOf(mode).name << " " << rowOf(rule).name << " box " << i);
        expectSameMaskedLevel(scene, view, cover, {given.states[i], given.boxes[i], 0}, {gpuStates[i], gpuBoxes[i], 0});
        const bool partial = gpuStates[i].verdict == gpu::kVerdictPartial;
        masked += partial && maskingFactor(gpuBoxes[i].cover) > 1.2F ? 1 : 0;
      }
      EXPECT_GT(masked, 100U) << rowOf(mode).name;
    }
  }
}

TEST_F(AnalyseGl, MapEqualsTheTwin) {
  std::size_t verdicts[gpu::kVerdictCount] = {};
  compare(CullMode::kHom, verdicts);
  EXPECT_GT(verdicts[gpu::kVerdictOccluded], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictOpen], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictPartial], 1000U);
}

TEST_F(AnalyseGl, MapWithDepthEqualsTheTwin) {
  std::size_t verdicts[gpu::kVerdictCount] = {};
  compare(CullMode::kHomDepth, verdicts);
  EXPECT_GT(verdicts[gpu::kVerdictOccluded], 20U);
  EXPECT_GT(verdicts[gpu::kVerdictOpen], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictPartial], 1000U);
}

TEST_F(AnalyseGl, DepthPyramidEqualsTheTwinAndTellsStaleFromOccluded) {
  std::size_t verdicts[gpu::kVerdictCount] = {};
  compare(CullMode::kHiz, verdicts);
  EXPECT_GT(verdicts[gpu::kVerdictOccluded], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictStale], 50U);
  EXPECT_GT(verdicts[gpu::kVerdictOpen], 100U);
  EXPECT_GT(verdicts[gpu::kVerdictPartial], 1000U);
}

TEST_F(AnalyseGl, EveryMeasureEqualsTheTwinOnEveryCover) {
  for (const CullMode mode : {CullMode::kHom, CullMode::kHomDepth, CullMode::kHiz}) {
    for (const LvMeasureRow& measure : lvMeasureTable()) {
      std::size_t verdicts[gpu::kVerdictCount] = {};
      compare(mode, verdicts, measure.id);
      EXPECT_GT(verdicts[gpu::kVerdictPartial], 1000U);
      compare(mode, verdicts, measure.id, 1);
    }
  }
}

TEST_F(AnalyseGl, DecidedObjectsAreLeftAlone) {
  const SceneData scene = sceneOfCount(4);
  const render::SceneBuffers buffers(scene);
  ObjectStore objects(buffers.objectCount());
  VisibilityPass pass(objects);
  const ScreenSize size{64, 64};
  const GivenMap map(size, std::vector<float>(64 * 64, 0.0F));
  const gpu::CullView view = makeView(scene, {}, size, 0.0F);
  pass.setView(view);
  const std::vector<gpu::ObjectState> decided = {{gpu::kVerdictOutside, 0, 20, -1.0F},
                                                 {gpu::kVerdictOccluder, 0, 20, -1.0F},
                                                 {gpu::kVerdictNear, 0, 20, -1.0F},
                                                 {gpu::kVerdictOpen, 0, 20, -1.0F}};
  objects.states.write(0, std::as_bytes(std::span(decided)));
  pass.analyse(buffers.bindings(), view.traits, {&map.pass.texture(), nullptr, nullptr});
  const auto states = objects.states.read<gpu::ObjectState>(4);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(states[i].verdict, decided[i].verdict);
}

}  // namespace
}  // namespace jalousie::visibility
