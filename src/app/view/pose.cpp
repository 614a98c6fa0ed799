// Poses of the viewer's camera, in spherical coordinates around the eye or the target.
#include "app/view/pose.h"

#include <algorithm>
#include <cmath>

namespace jalousie::app {
namespace {

constexpr float kMostPitch = 1.553F;  // 89 degrees: at the poles the yaw is undefined
constexpr float kZoomPerStep = 0.85F;
/// Least distance from eye to target, share of the target's coordinates: some hundred units in their last place.
constexpr float kLeastDistance = 1e-4F;
constexpr float kMostDistance = 1e12F;  // world units

struct Angles {
  float yaw, pitch;
};

Angles anglesOf(const glm::vec3& direction) {
  const glm::vec3 d = glm::normalize(direction);
  return {std::atan2(d.x, d.z), std::asin(std::clamp(d.y, -1.0F, 1.0F))};
}

glm::vec3 directionOf(const Angles& a) {
  return {std::sin(a.yaw) * std::cos(a.pitch), std::sin(a.pitch), std::cos(a.yaw) * std::cos(a.pitch)};
}

glm::vec3 rotated(const glm::vec3& direction, float yaw, float pitch) {
  Angles angles = anglesOf(direction);
  angles.yaw += yaw;
  angles.pitch = std::clamp(angles.pitch + pitch, -kMostPitch, kMostPitch);
  return glm::length(direction) * directionOf(angles);
}

struct Frame {
  glm::vec3 right, up, forward;
};

Frame frameOf(const Pose& pose) {
  const glm::vec3 forward = glm::normalize(pose.look - pose.eye);
  const glm::vec3 side = glm::cross(forward, glm::vec3(0.0F, 1.0F, 0.0F));
  const glm::vec3 right = glm::length(side) > 1e-5F ? glm::normalize(side) : glm::vec3(1.0F, 0.0F, 0.0F);
  return {right, glm::cross(right, forward), forward};
}

}  // namespace

bool isUsable(const Pose& pose) {
  for (glm::length_t k = 0; k < 3; ++k)
    if (!std::isfinite(pose.eye[k]) || !std::isfinite(pose.look[k])) return false;
  const float distance = glm::length(pose.eye - pose.look);
  return distance > 0.0F && std::isfinite(distance);
}

bool isUsable(const WorldPose& pose) {
  return isUsable(relativeTo(pose.eye, pose));
}

WorldPose inWorld(const Pose& pose, const glm::dvec3& originWorld) {
  return {glm::dvec3(pose.eye) + originWorld, glm::dvec3(pose.look) + originWorld};
}

Pose relativeTo(const glm::dvec3& originWorld, const WorldPose& pose) {
  return {glm::vec3(pose.eye - originWorld), glm::vec3(pose.look - originWorld)};
}

Pose poseOf(const scene::Camera& camera, float distance) {
  const glm::vec3 eye = camera.positionWorld();
  const glm::vec3 forward = camera.forwardWorld();
  const glm::vec3 look = eye + distance * forward;
  if (!camera.isOrthographic()) return {eye, look};
  return {look - camera.halfSize->y / std::tan(0.5F * camera.fovY) * forward, look};
}

float targetDistance(const scene::Camera& camera, const Aabb& sceneWorld) {
  if (sceneWorld.empty()) return 1.0F;
  const glm::vec3 forward = -glm::vec3(camera.worldFromCamera[2]);
  const float ahead = glm::dot(sceneWorld.center() - camera.positionWorld(), forward);
  return std::max({ahead, 0.01F * sceneWorld.diagonal(), 1e-4F});
}

Pose orbited(const Pose& pose, float yaw, float pitch) {
  return {pose.look + rotated(pose.eye - pose.look, yaw, pitch), pose.look};
}

Pose turned(const Pose& pose, float yaw, float pitch) {
  return {pose.eye, pose.eye + rotated(pose.look - pose.eye, yaw, pitch)};
}

namespace {

/// The least distance at which rounding keeps a target apart from the eye.
float leastDistance(const glm::vec3& at) {
  const glm::vec3 size = glm::abs(at);
  return kLeastDistance * std::max({size.x, size.y, size.z, 1e-3F});
}

/// Moves eye and target, and keeps them apart at the new position.
Pose shifted(const Pose& pose, const glm::vec3& offset, const glm::vec3& forward) {
  const Pose result{pose.eye + offset, pose.look + offset};
  const float least = leastDistance(result.eye);
  if (glm::length(pose.look - pose.eye) >= least) return result;
  return {result.eye, result.eye + least * forward};
}

}  // namespace

Pose moved(const Pose& pose, const glm::vec3& step) {
  const Frame frame = frameOf(pose);
  const glm::vec3 offset = step.x * frame.right + step.y * glm::vec3(0.0F, 1.0F, 0.0F) + step.z * frame.forward;
  return shifted(pose, offset, frame.forward);
}

Pose panned(const Pose& pose, float right, float up, float focalPixels) {
  const Frame frame = frameOf(pose);
  const float worldPerPixel = glm::length(pose.look - pose.eye) / focalPixels;
  const glm::vec3 offset = -worldPerPixel * (right * frame.right + up * frame.up);
  return shifted(pose, offset, frame.forward);
}

Pose zoomed(const Pose& pose, float steps) {
  const glm::vec3 away = pose.eye - pose.look;
  const float distance = glm::length(away);
  const float least = std::min(leastDistance(pose.look), distance);
  const float most = std::max(kMostDistance, distance);
  const float wanted = std::clamp(distance * std::pow(kZoomPerStep, steps), least, most);
  return {pose.look + wanted / distance * away, pose.look};
}

Pose framed(const Pose& pose, const Aabb& boxWorld, float fovY, float aspect) {
  if (boxWorld.empty()) return pose;
  const float radius = std::max({0.5F * boxWorld.diagonal(), 1e-4F, leastDistance(boxWorld.center())});
  const float half = std::atan(std::tan(0.5F * fovY) * std::min(aspect, 1.0F));
  const glm::vec3 direction = glm::normalize(pose.eye - pose.look);
  return {boxWorld.center() + radius / std::sin(half) * direction, boxWorld.center()};
}

}  // namespace jalousie::app
