// Poses of the viewer's camera: moves around a point and through the scene.
#pragma once

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "scene/camera.h"

namespace jalousie::app {

/// Position and target of a camera, relative to the origin of the scene that is shown (SceneData::originWorld). +y is
/// up.
struct Pose {
  glm::vec3 eye{0.0F, 0.0F, 4.0F};
  glm::vec3 look{0.0F};
};

/// The same in the world of the file, as --eye and --look.
struct WorldPose {
  glm::dvec3 eye{0.0, 0.0, 4.0};
  glm::dvec3 look{0.0};
};

WorldPose inWorld(const Pose& pose, const glm::dvec3& originWorld);
Pose relativeTo(const glm::dvec3& originWorld, const WorldPose& pose);

/// Whether a camera can have this pose: all coordinates are finite, and eye and target differ.
bool isUsable(const Pose& pose);
bool isUsable(const WorldPose& pose);

/// The pose of a camera with its target at a distance. A roll of the camera is dropped. For an orthographic camera, the
/// pose of the perspective camera on the same axis that shows as much at the target.
Pose poseOf(const scene::Camera& camera, float distance);

/// Distance for the target of a camera: to the centre of the scene, at least 1 % of the scene's diagonal.
float targetDistance(const scene::Camera& camera, const Aabb& sceneWorld);

/// Turns the eye around the target, at most up to the poles.
/// @param yaw, pitch  radians; positive moves the eye right and up
Pose orbited(const Pose& pose, float yaw, float pitch);
/// Turns the target around the eye, at most up to the poles.
/// @param yaw, pitch  radians; positive looks left and up
Pose turned(const Pose& pose, float yaw, float pitch);
/// Moves eye and target. @param step  along the camera's right, the world's up, the camera's forward; world units
Pose moved(const Pose& pose, const glm::vec3& step);
/// Moves eye and target parallel to the screen, so that the target follows the pointer.
/// @param right, up  pixels   @param focalPixels  of the camera
Pose panned(const Pose& pose, float right, float up, float focalPixels);
/// Scales the distance to the target by 0.85 per step of the wheel. The distance is limited so that rounding keeps eye
/// and target apart.
Pose zoomed(const Pose& pose, float steps);
/// Looks at a box from the same direction, so that its bounding sphere fills the view. @param fovY  radians
Pose framed(const Pose& pose, const Aabb& boxWorld, float fovY, float aspect);

}  // namespace jalousie::app
