// One scene and camera for the tests of the culling methods: objects inside and outside the frustum, some occluded.
#pragma once

#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/culling.h"
#include "support/gl_test.h"
#include "support/scenes.h"

namespace jalousie::render {

inline constexpr std::uint32_t kMethodWidth = 320;
inline constexpr std::uint32_t kMethodHeight = 180;

class MethodGl : public test::GlTest {
 protected:
  MethodGl()
      : scene_(scene::buildScene(spheresWithOccluders())),
        camera_(scene::lookAt({0, 0, 7}, {0.5F, 0, 0}, scene_.boundsWorld)) {}

  /// Spheres with a cube in each that lies inside of all levels.
  static asset::SceneFile spheresWithOccluders() {
    asset::SceneFile file = test::randomSpheres(400, 6.0F, 21);
    file.chains[0].occluders = {{solidOf({glm::vec3(-0.45F), glm::vec3(0.45F)}), 4}};
    return file;
  }

  /// Levels by screen-space error alone, so that modes can be compared.
  static FrameOptions options(CullMode mode) {
    FrameOptions result = test::pixelErrorOptions();
    result.cullMode = mode;
    return result;
  }

  static constexpr std::uint32_t kOddWidth = 201;
  static constexpr std::uint32_t kOddHeight = 113;

  /// What a renderer culls, and its picture.
  struct Frame {
    FrameStatistics statistics;
    std::vector<std::uint8_t> pixels;
  };
  static Frame draw(const scene::SceneData& scene, const FrameOptions& frameOptions, const scene::Camera& camera,
                    const scene::Camera& drawCamera) {
    FrameRenderer renderer(scene, kOddWidth, kOddHeight);
    renderer.render(frameOptions, camera, drawCamera);
    return {renderer.readStatistics(), renderer.readImage().pixels};
  }
  static Frame draw(const scene::SceneData& scene, const FrameOptions& frameOptions, const scene::Camera& camera) {
    return draw(scene, frameOptions, camera, camera);
  }

  /// Renders frames from the same camera. @param renderer  keeps its history
  FrameStatistics settle(FrameRenderer& renderer, CullMode mode, int frames = 3) const {
    for (int frame = 0; frame < frames; ++frame)
      renderer.render(options(mode), camera_, camera_);
    return renderer.readStatistics();
  }

  scene::SceneData scene_;
  scene::Camera camera_;
};

}  // namespace jalousie::render
