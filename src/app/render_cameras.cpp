// Chooses the cameras: explicit positions first, then a frame of the path, then the whole scene.
#include "app/render_cameras.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/command_memory.h"
#include "app/path_camera.h"
#include "core/error.h"

namespace jalousie::app {
namespace {

scene::Camera wholeScene(const RenderOptions& options, const scene::SceneData& scene) {
  return scene::frameBox(scene.boundsWorld, static_cast<float>(options.width) / static_cast<float>(options.height));
}

scene::Camera pathCamera(const RenderOptions& options, const scene::SceneData& scene,
                         const std::vector<asset::Camera>& path, float frame) {
  if (path.empty() && scene.motion.empty())
    throw Error(ErrorCode::kUsage, "the scene has no camera; say --eye and --look instead of a frame", options.scene);
  const std::uint32_t frames = pathFrames(path, scene.motion.lastKey);
  if (frame > static_cast<float>(frames - 1))
    throw Error(ErrorCode::kUsage, fmt::format("frame {} is beyond the camera path (0..{})", frame, frames - 1),
                options.scene);
  return path.empty() ? wholeScene(options, scene) : scene::cameraAtFrame(path.front(), frame);
}

/// @param eye, look  in the file's world
scene::Camera placed(const glm::dvec3& eye, const glm::dvec3& look, const scene::SceneData& scene) {
  return scene::lookAt(glm::vec3(eye - scene.originWorld), glm::vec3(look - scene.originWorld), scene.boundsWorld);
}

scene::Camera drawCamera(const RenderOptions& options, const scene::SceneData& scene,
                         const std::vector<asset::Camera>& path) {
  if (options.eye) return placed(*options.eye, *options.look, scene);
  if (options.frame || !path.empty()) return pathCamera(options, scene, path, options.frame.value_or(0.0F));
  return wholeScene(options, scene);
}

}  // namespace

std::uint32_t pathFrames(const std::vector<asset::Camera>& path, float lastKey) {
  return std::max(path.empty() ? 1U : scene::frameCount(path.front()), scene::frameCount(lastKey));
}

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
                 : options.freezeFrame ? pathCamera(options, scene, path, *options.freezeFrame)
                                       : cameras.draw;
  return cameras;
}

}  // namespace jalousie::app
