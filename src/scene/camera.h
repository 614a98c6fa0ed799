// Cameras, their matrices, and poses along a recorded path.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "asset/scene_types.h"
#include "core/aabb.h"

namespace jalousie::scene {

/// Frames per second of camera paths: frame k is the pose at k / kPathRate seconds.
inline constexpr float kPathRate = 30.0F;

/// Looks along -z of its frame, y up.
struct Camera {
  glm::mat4 worldFromCamera{1.0F};    ///< rigid
  float fovY = 0.8F;                  ///< radians; of a perspective camera
  std::optional<glm::vec2> halfSize;  ///< orthographic: half the width and height of what it shows, world units, > 0
  float zNear = 0.1F;                 ///< world units; > 0, or >= 0 for an orthographic camera
  std::optional<float> zFar;          ///< infinite if absent; an orthographic camera has one

  bool isOrthographic() const { return halfSize.has_value(); }
  glm::vec3 positionWorld() const { return glm::vec3(worldFromCamera[3]); }
  /// Unit vector.
  glm::vec3 forwardWorld() const { return -glm::vec3(worldFromCamera[2]); }
};

/// Half the height of what an orthographic camera shows, world units. If the picture has another shape than the camera,
/// the camera's rectangle fits into it, and the picture shows more. @param aspect  width / height   @pre
/// camera.isOrthographic()
float halfHeight(const Camera& camera, float aspect);

/// Reversed depth for GL_ZERO_TO_ONE: the near plane maps to z = w, the far plane (or infinity) to z = 0.
glm::mat4 clipFromWorld(const Camera& camera, float aspect);

/// Pixels per unit of tangent, viewportHeight / (2 tan(fovY / 2)); of an orthographic camera pixels per world unit,
/// viewportHeight / (2 halfHeight). @param viewport  width and height, pixels
float focalPixels(const Camera& camera, const glm::uvec2& viewport);

/// Camera at eye, looking at target, +y up (or +z where the view is vertical). Errors: kUsage if eye equals target.
Camera lookAt(const glm::vec3& eye, const glm::vec3& target, const Aabb& sceneWorld);

/// Camera that sees the whole box as large as possible, from the front and slightly above. @param aspect  width /
/// height
Camera frameBox(const Aabb& sceneWorld, float aspect);

/// Pose of a recorded camera at a frame; outside the path's keys, the pose of the nearest key. A camera without a
/// track ignores the frame.
Camera cameraAtFrame(const asset::Camera& recorded, float frame);

/// Number of frames from 0 to a time, at least 1. @param seconds  of the last key
std::uint32_t frameCount(float seconds);
/// Number of frames from 0 to the last key of a camera, at least 1.
std::uint32_t frameCount(const asset::Camera& recorded);
/// Time of a frame of a path, and of the animations that play with it; seconds.
inline float secondsAt(float frame) {
  return frame / kPathRate;
}

}  // namespace jalousie::scene
