// The occlusion map with depth: what lies in front of the occluders is kept.
#include <gtest/gtest.h>

#include "render/methods/method_fixture.h"
#include "visibility/frame_counters.h"

namespace jalousie::render {
namespace {

TEST_F(MethodGl, HomDepthKeepsWhatLiesInFrontOfALargeOccluderAndHomDoesNot) {
  const scene::SceneData scene = scene::buildScene(test::groundPlane(150, 3));
  const scene::Camera camera = test::tour(scene, 6, 5)(0);
  FrameRenderer renderer(scene, kMethodWidth, kMethodHeight);
  renderer.render(options(CullMode::kHom), camera, camera);
  const std::uint64_t withoutDepth = renderer.readStatistics().drawn;
  renderer.render(options(CullMode::kHomDepth), camera, camera);
  EXPECT_GT(renderer.readStatistics().drawn, withoutDepth);
}

}  // namespace
}  // namespace jalousie::render
