// Walks a path frame by frame.
#include "lv_path.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "compare/frame_objects.h"
#include "gl_bench.h"

namespace jalousie::bench {
namespace {

constexpr int kWarmUp = 40;  // frames before the path
constexpr float kDegreesPerFrame = 0.25F;

}  // namespace

scene::Camera Path::at(int frame) const {
  scene::Camera camera = start;
  const float angle = glm::radians(kDegreesPerFrame * static_cast<float>(frame));
  const glm::mat4 about = glm::rotate(glm::translate(glm::mat4(1.0F), center), angle, {0, 1, 0});
  camera.worldFromCamera = glm::translate(about, -center) * start.worldFromCamera;
  return camera;
}

void walk(render::FrameRenderer& renderer, const render::FrameOptions& options, const Path& path,
          const std::function<bool(int frame)>& isDrawn, const std::function<void(int frame)>& visit) {
  for (int frame = -kWarmUp; frame <= path.frames; ++frame) {
    const scene::Camera camera = path.at(std::max(0, frame));
    render::FrameOptions now = options;
    now.skipDraw = frame <= 0 || !isDrawn(frame);
    renderer.render(now, camera, camera);
    if (frame > 0) visit(frame);
  }
}

void SwitchTotals::add(render::FrameRenderer& renderer) {
  const compare::FrameObjects now = compare::countObjects(renderer);
  require(now.switched <= now.visible, "more objects have switched than are visible");
  switched += static_cast<double>(now.switched);
  visible += static_cast<double>(now.visible);
}

double SwitchTotals::perObject() const {
  require(visible > 0.0, "no object is visible");
  return switched / visible;
}

}  // namespace jalousie::bench
