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

TEST_F(CountGl, FiguresEqualTheTwinAndArriveThroughTheRing) {
  for (const Detail detail : {Detail::kDiscrete, Detail::kTessellation}) {
    const SceneData scene = scene::buildScene(mixedFile(1000), {.patches = true});
    const render::SceneBuffers buffers(scene);
    ObjectStore objects(buffers.objectCount());
    VisibilityPass pass(objects);
    DrawListPass lists(scene);
    DrawList list(scene, gpu::kMarkLate, {Submission::kInstanced, 1000, true});
    StatisticsPass ring;
    EXPECT_FALSE(ring.latest().has_value());
    const gpu::CullView view = makeView(scene, {}, {64, 64}, 0.0F, {.cullMode = CullMode::kHiz, .detail = detail});
    pass.setView(view);
    Random random(3);
    std::vector<gpu::ObjectState> states;
    std::vector<gpu::uint> marks;
    for (std::uint64_t frame = 1; frame <= 7; ++frame) {
      states.clear();
      marks.clear();
      for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        states.push_back({random.below(gpu::kVerdictCount), random.below(scene.chains[scene.objects[i].chain].lodCount),
                          1 + random.below(20), -1.0F});
        marks.push_back(random.below(16));
      }
      objects.states.write(0, std::as_bytes(std::span(states)));
      objects.marks.write(0, std::as_bytes(std::span(marks)));
      lists.build(list, buffers.bindings(), pass.decided());
      ring.endFrame(buffers.bindings(), pass.decided(), view, nullptr, list);
    }
    const auto& record = ring.finish();
    ASSERT_TRUE(record.has_value());
    EXPECT_EQ(record->frame, 7U);
    EXPECT_EQ(record->counters, countStates(scene, view, states, marks));
    EXPECT_GT(triangleSum(record->counters), 1000U);
  }
}

}  // namespace
}  // namespace jalousie::visibility
