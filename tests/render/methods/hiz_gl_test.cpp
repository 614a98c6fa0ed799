// Two phases: what was visible is drawn first, what appears is drawn in the same frame.
#include <gtest/gtest.h>

#include "render/methods/method_fixture.h"

namespace jalousie::render {
namespace {

TEST_F(MethodGl, HizDrawsWhatAppearsInTheSameFrame) {
  FrameRenderer renderer(scene_, kMethodWidth, kMethodHeight);
  FrameRenderer everything(scene_, kMethodWidth, kMethodHeight);
  settle(renderer, CullMode::kHiz);
  const scene::Camera other = scene::lookAt({7, 1, 0}, {0, 0, 0.5F}, scene_.boundsWorld);
  renderer.render(options(CullMode::kHiz), other, other);
  everything.render(options(CullMode::kFull), other, other);
  const FrameStatistics statistics = renderer.readStatistics();
  EXPECT_GT(statistics.drawnEarly, 0U);
  EXPECT_GT(statistics.drawn, statistics.drawnEarly) << "the second phase has something to draw";
  EXPECT_EQ(renderer.readImage().pixels, everything.readImage().pixels);
}

}  // namespace
}  // namespace jalousie::render
