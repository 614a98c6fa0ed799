// The occlusion map without depth: near objects are its occluders.
#include <gtest/gtest.h>

#include "core/aabb.h"
#include "render/methods/method_fixture.h"
#include "visibility/occlusion_map_pass.h"

namespace jalousie::render {
namespace {

TEST_F(MethodGl, HomDrawsNearObjectsIntoTheMapAndTestsTheOthers) {
  FrameRenderer renderer(scene_, kMethodWidth, kMethodHeight);
  FrameOptions near = options(CullMode::kHom);
  near.occluderDistance = 3.0F;
  renderer.render(near, camera_, camera_);
  const FrameStatistics some = renderer.readStatistics();
  near.occluderDistance = 0.0F;
  renderer.render(near, camera_, camera_);
  const FrameStatistics none = renderer.readStatistics();
  EXPECT_GT(some.occluders, 0U);
  EXPECT_GT(some.culledOcclusion, 0U);
  EXPECT_EQ(none.occluders, 0U);
  EXPECT_EQ(none.culledOcclusion, 0U) << "an empty map occludes nothing";
  for (const float open : renderer.map().readOpenPixels())
    ASSERT_EQ(open, 1.0F);
}

}  // namespace
}  // namespace jalousie::render
