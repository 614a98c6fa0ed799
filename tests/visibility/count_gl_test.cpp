// The kernels that count pixels and frame statistics, exactly against their CPU twins.
#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"
#include "render/scene_buffers.h"
#include "support/gl_test.h"
#include "visibility/draw_list_pass.h"
#include "visibility/item_buffer.h"
#include "visibility/kernel_input.h"
#include "visibility/statistics_pass.h"
#include "visibility/visibility_pass.h"

namespace jalousie::visibility {
namespace {

using scene::SceneData;

class ItemBufferGl : public test::GlTest {};

TEST_F(ItemBufferGl, CountsEqualTheTwin) {
  constexpr std::uint32_t kObjects = 500;
  ObjectStore objects(kObjects);
  VisibilityPass pass(objects);
  for (const ScreenSize size : {ScreenSize{1, 1}, {33, 5}, {640, 360}, {1366, 77}, {256, 16}, {257, 17}}) {
    for (const std::uint32_t cell : {0U, 1U, 3U, 40U}) {
      Random random(size.width + cell);
      gl::Texture items(GL_TEXTURE_2D, GL_R32UI, {size.width, size.height, 1, 1}, "items");
      items.setSampling(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
      std::vector<std::uint32_t> values(std::size_t{size.width} * size.height, kObjects);  // cell 0: one object
      const std::uint32_t salt = random.below(1000);
      for (std::uint32_t y = 0; y < size.height && cell > 0; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x)
          values[std::size_t{y} * size.width + x] =
              cell == 1 ? random.below(kObjects + 1) : ((x / cell) * 31 + (y / cell) * 17 + salt) % (kObjects + 1);
      glTextureSubImage2D(items.id(), 0, 0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height),
                          GL_RED_INTEGER, GL_UNSIGNED_INT, values.data());
      pass.countPixels(items);
      EXPECT_EQ(objects.pixelCounts.read<gpu::uint>(kObjects), countPixels(values, kObjects))
          << size.width << "x" << size.height << " cell " << cell;
    }
  }
}

class CountGl : public test::GlTest {};

/// States and marks as no scene gives them: every verdict, level and mark, with cross-fades.
struct RandomDecisions {
  std::vector<gpu::ObjectState> states;
  std::vector<gpu::ScreenBox> boxes;
  std::vector<gpu::uint> marks;
};

RandomDecisions randomDecisions(const SceneData& scene, Random& random) {
  RandomDecisions result;
  result.boxes.resize(scene.objects.size());
  for (const gpu::Object& object : scene.objects) {
    const gpu::uint levels = scene.chains[object.chain].lodCount;
    const gpu::uint lod = random.below(levels);
    result.states.push_back({random.below(gpu::kVerdictCount), lod, 1 + random.below(20), -1.0F});
    gpu::uint mark = random.below(16);
    if (levels > 1 && random.below(3) == 0) {
      const bool fromCoarser = lod == 0 || (lod + 1 < levels && random.below(2) == 0);
      mark |= (1 + random.below(gpu::kDefaultFadeFrames)) << gpu::kMarkFadeShift |
              (fromCoarser ? gpu::kMarkFromCoarser : 0);
    }
    result.marks.push_back(mark);
  }
  return result;
}

/// Frames with random decisions through the ring. @param capacity  of both lists
void expectCounts(const SceneData& scene, const FramePolicy& policy, std::uint32_t capacity) {
  const render::SceneBuffers buffers(scene);
  ObjectStore objects(buffers.objectCount());
  VisibilityPass pass(objects);
  DrawListPass lists(scene);
  const DrawListOptions options{Submission::kInstanced, capacity, true};
  DrawList early(scene, gpu::kMarkEarly, options);
  DrawList late(scene, gpu::kMarkLate, options);
  StatisticsPass ring;
  EXPECT_FALSE(ring.latest().has_value());
  const gpu::CullView view = makeView(scene, {}, {64, 64}, 0.0F, policy);
  pass.setView(view);
  Random random(3 + capacity);
  FrameCounters expected = {};
  for (std::uint64_t frame = 1; frame <= 7; ++frame) {
    const RandomDecisions input = randomDecisions(scene, random);
    objects.states.write(0, std::as_bytes(std::span(input.states)));
    objects.marks.write(0, std::as_bytes(std::span(input.marks)));
    lists.build(early, buffers.bindings(), pass.decided());
    lists.build(late, buffers.bindings(), pass.decided());
    ring.endFrame(buffers.bindings(), pass.decided(), view, &early, late);
    const ObjectDecisions decisions{input.states, input.boxes, input.marks};
    const DrawLists first = buildDrawLists(scene, view, decisions, gpu::kMarkEarly, options);
    const DrawLists second = buildDrawLists(scene, view, decisions, gpu::kMarkLate, options);
    expected = countStates(scene, view, input.states, input.marks, {first.placed, second.placed});
  }
  const auto& record = ring.finish();
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->frame, 7U);
  EXPECT_EQ(record->counters, expected);
  const auto most = static_cast<std::uint32_t>(2 * scene.objects.size());
  EXPECT_EQ(expected[gpu::kCounterDropped] > 0, capacity < most);
  EXPECT_GT(triangleSum(record->counters), capacity);
  if (has(view.traits, gpu::kTraitPatches)) return;
  EXPECT_EQ(expected[gpu::kCounterFading] > 0, capacity > 1);
}

TEST_F(CountGl, FiguresEqualTheTwinAndArriveThroughTheRing) {
  const SceneData scene = scene::buildScene(mixedFile(1000), {.patches = true});
  for (const CullMode mode : {CullMode::kHiz, CullMode::kFrustum}) {
    for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
      for (const std::uint32_t capacity : {2000U, 200U, 1U}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(mode) << static_cast<int>(detail) << ' ' << capacity);
        expectCounts(scene, {.cullMode = mode, .detail = detail}, capacity);
      }
    }
  }
}

}  // namespace
}  // namespace jalousie::visibility
