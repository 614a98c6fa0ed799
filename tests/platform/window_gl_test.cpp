// A window's context draws what the headless one draws.
#include "platform/window.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <optional>

#include "core/error.h"
#include "gl/debug_log.h"
#include "platform/headless_context.h"
#include "render/frame_renderer.h"
#include "support/stages.h"

namespace jalousie::platform {
namespace {

ImageRgba8 frame(const scene::SceneData& scene) {
  const gl::DebugLog log;
  render::FrameRenderer renderer(scene, 200, 120);
  const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
  render::FrameOptions options;
  options.occluderDistance = test::kWallOccluderDistance;
  renderer.render(options, camera, camera);
  ImageRgba8 image = renderer.readImage();
  EXPECT_TRUE(log.problems().empty()) << log.problems().front();
  return image;
}

TEST(WindowGl, HeadlessAndWindowFramesAreEqual) {
  const scene::SceneData scene = scene::buildScene(test::spheresBehindWall(0.3F));
  ImageRgba8 headless;
  std::string headlessRenderer;
  try {
    const HeadlessContext context(true);
    headless = frame(scene);
    headlessRenderer = context.capabilities().renderer;
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  std::optional<Window> window;
  try {
    window.emplace(WindowOptions{.width = 200, .height = 120, .title = "test", .debug = true});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kNoGpu);
    GTEST_SKIP() << error.what();
  }
  EXPECT_FALSE(window->shouldClose());
  const ImageRgba8 inWindow = frame(scene);
  glfwSwapBuffers(window->handle());
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  window->framebufferSize(width, height);
  EXPECT_EQ(width, 200U);
  EXPECT_EQ(height, 120U);
  if (window->capabilities().renderer == headlessRenderer) {
    EXPECT_EQ(inWindow.pixels, headless.pixels);
  }
}

}  // namespace
}  // namespace jalousie::platform
