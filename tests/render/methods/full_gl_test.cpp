// No culling: everything is drawn, in view or not.
#include <gtest/gtest.h>

#include "render/methods/method_fixture.h"

namespace jalousie::render {
namespace {

TEST_F(MethodGl, FullDrawsEveryObjectWhateverTheCameraSees) {
  FrameRenderer renderer(scene_, kMethodWidth, kMethodHeight);
  const scene::Camera away = scene::lookAt({0, 0, 60}, {0, 0, 120}, scene_.boundsWorld);
  renderer.render(options(CullMode::kFull), away, away);
  EXPECT_EQ(renderer.readStatistics().drawn, scene_.objects.size());
}

}  // namespace
}  // namespace jalousie::render
