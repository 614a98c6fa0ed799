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

/// Perspective camera: looks along -z of its frame, y up.
struct Camera {
  glm::mat4 worldFromCamera{1.0F};  ///< rigid
  float fovY = 0.8F;                ///< radians
  float zNear = 0.1F;               ///< world units, > 0
  std::optional<float> zFar;        ///< infinite if absent

  glm::vec3 positionWorld() const { return glm::vec3(worldFromCamera[3]); }
};

/// Reversed depth for GL_ZERO_TO_ONE: the near plane maps to z = w, the far plane (or infinity) to z = 0.
glm::mat4 clipFromWorld(const Camera& camera, float aspect);

/// Pixels per unit of tangent: viewportHeight / (2 tan(fovY / 2)).
float focalPixels(const Camera& camera, std::uint32_t viewportHeight);

/// Camera at eye, looking at target, +y up (or +z where the view is vertical). Errors: kUsage if eye equals target.
Camera lookAt(const glm::vec3& eye, const glm::vec3& target, const Aabb& sceneWorld);

/// Camera that sees the whole box as large as possible, from the front and slightly above. @param aspect  width /
/// height
Camera frameBox(const Aabb& sceneWorld, float aspect);

/// Pose of a recorded camera at a frame; outside the path's keys, the pose of the nearest key. A camera without a
/// track ignores the frame.
Camera cameraAtFrame(const asset::Camera& recorded, float frame);

/// Number of frames from 0 to the last key, at least 1.
std::uint32_t frameCount(const asset::Camera& recorded);

}  // namespace jalousie::scene
