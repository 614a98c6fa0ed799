// How the viewer's camera moves: around a point, and through the scene.
#pragma once

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "scene/camera.h"

namespace jalousie::app {

/// Where the camera is and what it looks at, world units; +y is up. The same as --eye and --look.
struct Pose {
  glm::vec3 eye{0.0F, 0.0F, 4.0F};
  glm::vec3 look{0.0F};
};

/// Whether a camera can stand there: all finite, eye and target apart.
bool isUsable(const Pose& pose);

/// The pose of a camera, with its target at a distance. Loses a roll.
Pose poseOf(const scene::Camera& camera, float distance);

/// Distance from a camera at which a target makes sense: to the centre of the scene, at least a hundredth of it.
float targetDistance(const scene::Camera& camera, const Aabb& sceneWorld);

/// Turns around the target. @param yaw, pitch  radians; positive moves the eye right and up. Never over the poles.
Pose orbited(const Pose& pose, float yaw, float pitch);
/// Turns on the spot. @param yaw, pitch  radians; positive looks left and up
Pose turned(const Pose& pose, float yaw, float pitch);
/// Moves eye and target. @param step  right, up (world), forward; world units
Pose moved(const Pose& pose, const glm::vec3& step);
/// Moves eye and target in the plane of the picture, so that the target follows the pointer.
/// @param right, up  pixels   @param focalPixels  of the camera
Pose panned(const Pose& pose, float right, float up, float focalPixels);
/// Comes nearer to the target by a factor per step of the wheel, never so near or far that eye and target are lost to
/// rounding.
Pose zoomed(const Pose& pose, float steps);
/// Looks at a box from the same side, so that its bounding sphere fills the view. @param fovY  radians
Pose framed(const Pose& pose, const Aabb& boxWorld, float fovY, float aspect);

}  // namespace jalousie::app
