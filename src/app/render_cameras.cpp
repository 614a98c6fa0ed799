// Chooses the cameras: explicit positions first, then a frame of the path, then the whole scene.
#include "app/render_cameras.h"

#include <fmt/format.h>

#include "app/command_memory.h"
#include "app/path_camera.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

scene::Camera pathCamera(const std::vector<asset::Camera>& path, float frame, const std::filesystem::path& file) {
  if (path.empty())
    throw Error(ErrorCode::kUsage, "the scene has no camera; say --eye and --look instead of a frame", file);
  const std::uint32_t frames = scene::frameCount(path.front());
  if (frame > static_cast<float>(frames - 1))
    throw Error(ErrorCode::kUsage, fmt::format("frame {} is beyond the camera path (0..{})", frame, frames - 1), file);
  return scene::cameraAtFrame(path.front(), frame);
}

scene::Camera drawCamera(const RenderOptions& options, const scene::SceneData& scene,
                         const std::vector<asset::Camera>& path) {
  if (options.eye) return scene::lookAt(*options.eye, *options.look, scene.boundsWorld);
  if (options.frame || !path.empty()) return pathCamera(path, options.frame.value_or(0.0F), options.scene);
  return scene::frameBox(scene.boundsWorld, static_cast<float>(options.width) / static_cast<float>(options.height));
}

}  // namespace

std::vector<asset::Camera> pathCameras(const RenderOptions& options, const scene::SceneData& scene) {
  if (options.path.empty()) return chosenFirst(scene.cameras, options.camera, options.scene);
  std::vector<asset::Camera> cameras = readWithin(options.path, options.memory, readingNeeds).cameras;
  if (cameras.empty()) throw Error(ErrorCode::kUsage, "holds no camera", options.path);
  return chosenFirst(std::move(cameras), options.camera, options.path);
}

RenderCameras renderCameras(const RenderOptions& options, const scene::SceneData& scene,
                            const std::vector<asset::Camera>& path) {
  RenderCameras cameras;
  cameras.draw = drawCamera(options, scene, path);
  cameras.cull = options.freezeEye     ? scene::lookAt(*options.freezeEye, *options.freezeLook, scene.boundsWorld)
                 : options.freezeFrame ? pathCamera(path, *options.freezeFrame, options.scene)
                                       : cameras.draw;
  return cameras;
}

}  // namespace jalousie::app
