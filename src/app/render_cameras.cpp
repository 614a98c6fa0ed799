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

/// @param eye, look  in the file's world
scene::Camera placed(const glm::dvec3& eye, const glm::dvec3& look, const scene::SceneData& scene) {
  return scene::lookAt(glm::vec3(eye - scene.originWorld), glm::vec3(look - scene.originWorld), scene.boundsWorld);
}

scene::Camera drawCamera(const RenderOptions& options, const scene::SceneData& scene,
                         const std::vector<asset::Camera>& path) {
  if (options.eye) return placed(*options.eye, *options.look, scene);
  if (options.frame || !path.empty()) return pathCamera(path, options.frame.value_or(0.0F), options.scene);
  return scene::frameBox(scene.boundsWorld, static_cast<float>(options.width) / static_cast<float>(options.height));
}

}  // namespace

std::vector<asset::Camera> pathFromFile(const std::filesystem::path& file, const MemoryLimit& memory,
                                        const glm::dvec3& originWorld) {
  asset::SceneFile path = readWithin(file, memory, readingNeeds);
  if (path.cameras.empty()) throw Error(ErrorCode::kUsage, "holds no camera", file);
  for (asset::Camera& camera : path.cameras) {
    const glm::dvec4 offset(path.originWorld - originWorld, 0.0);
    camera.worldFromParent[3] += offset;
    camera.worldFromCamera[3] += offset;
  }
  return std::move(path.cameras);
}

std::vector<asset::Camera> pathCameras(const RenderOptions& options, const scene::SceneData& scene) {
  if (options.path.empty()) return chosenFirst(scene.cameras, options.camera, options.scene);
  return chosenFirst(pathFromFile(options.path, options.memory, scene.originWorld), options.camera, options.path);
}

RenderCameras renderCameras(const RenderOptions& options, const scene::SceneData& scene,
                            const std::vector<asset::Camera>& path) {
  RenderCameras cameras;
  cameras.draw = drawCamera(options, scene, path);
  cameras.cull = options.freezeEye     ? placed(*options.freezeEye, *options.freezeLook, scene)
                 : options.freezeFrame ? pathCamera(path, *options.freezeFrame, options.scene)
                                       : cameras.draw;
  return cameras;
}

}  // namespace jalousie::app
