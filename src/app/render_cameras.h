// From options to cameras: which pose culls and which one draws.
#pragma once

#include <vector>

#include "app/render_options.h"
#include "scene/camera.h"
#include "scene/scene_data.h"

namespace jalousie::app {

struct RenderCameras {
  scene::Camera cull;
  scene::Camera draw;
};

/// Whether the animations of the scene follow the frame: it is named, and --time does not fix them.
inline bool playsAnimations(const RenderOptions& options) {
  return options.frame.has_value() && !options.time;
}

/// Frames of a camera path and of what moves, at least 1. @param path  may be empty   @param lastKey  of the
/// animations, seconds
std::uint32_t pathFrames(const std::vector<asset::Camera>& path, float lastKey);

/// Cameras of a file, relative to a point of its world. Errors: as readSceneFile; kUsage if it holds none.
std::vector<asset::Camera> pathFromFile(const std::filesystem::path& file, const MemoryLimit& memory,
                                        const glm::dvec3& originWorld);

/// Cameras of the path in use: those of options.path, else the scene's own; may be empty.
/// Errors: as readSceneFile; kUsage if options.path holds no camera.
std::vector<asset::Camera> pathCameras(const RenderOptions& options, const scene::SceneData& scene);

/// --eye and --look, else --frame of the path's first camera, else its start, else the whole scene in view.
/// @param path  as pathCameras()   Errors: kUsage for a frame beyond the path, and where there is no path and nothing
/// moves.
RenderCameras renderCameras(const RenderOptions& options, const scene::SceneData& scene,
                            const std::vector<asset::Camera>& path);

}  // namespace jalousie::app
