// Camera matrices (reversed depth, column vectors) and interpolation of glTF camera tracks.
#include "scene/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>

#include "core/check.h"
#include "core/error.h"

namespace jalousie::scene {
namespace {

/// Where time lies between two keys.
struct KeySpan {
  std::size_t first;
  std::size_t second;
  float weight;  ///< of the second
};

KeySpan findKeys(std::span<const float> times, float seconds) {
  const auto upper = std::upper_bound(times.begin(), times.end(), seconds);
  if (upper == times.begin()) return {0, 0, 0.0F};
  const std::size_t last = times.size() - 1;
  if (upper == times.end()) return {last, last, 0.0F};
  const auto second = static_cast<std::size_t>(upper - times.begin());
  const float length = times[second] - times[second - 1];
  return {second - 1, second, length > 0.0F ? (seconds - times[second - 1]) / length : 0.0F};
}

/// Near plane that suits a scene: depth is reversed and stored as float, so it may be small.
float nearPlaneFor(const Aabb& sceneWorld) {
  return std::max(1e-4F * sceneWorld.diagonal(), 1e-6F);
}

}  // namespace

float halfHeight(const Camera& camera, float aspect) {
  JAL_CHECK(camera.isOrthographic());
  return std::max(camera.halfSize->y, camera.halfSize->x / aspect);
}

namespace {

glm::mat4 orthographic(const Camera& camera, float aspect) {
  const float half = halfHeight(camera, aspect);
  const float depth = *camera.zFar - camera.zNear;
  glm::mat4 clipFromCamera(0.0F);
  clipFromCamera[0][0] = 1.0F / (half * aspect);
  clipFromCamera[1][1] = 1.0F / half;
  clipFromCamera[2][2] = 1.0F / depth;
  clipFromCamera[3][2] = *camera.zFar / depth;
  clipFromCamera[3][3] = 1.0F;
  return clipFromCamera;
}

}  // namespace

glm::mat4 clipFromWorld(const Camera& camera, float aspect) {
  if (camera.isOrthographic()) return orthographic(camera, aspect) * glm::inverse(camera.worldFromCamera);
  const float focal = 1.0F / std::tan(0.5F * camera.fovY);
  glm::mat4 clipFromCamera(0.0F);
  clipFromCamera[0][0] = focal / aspect;
  clipFromCamera[1][1] = focal;
  clipFromCamera[2][3] = -1.0F;
  if (camera.zFar) {
    const float scale = camera.zNear / (*camera.zFar - camera.zNear);
    clipFromCamera[2][2] = scale;
    clipFromCamera[3][2] = scale * *camera.zFar;
  } else {
    clipFromCamera[3][2] = camera.zNear;
  }
  return clipFromCamera * glm::inverse(camera.worldFromCamera);
}

float focalPixels(const Camera& camera, const glm::uvec2& viewport) {
  const glm::vec2 size(viewport);
  return size.y /
         (2.0F * (camera.isOrthographic() ? halfHeight(camera, size.x / size.y) : std::tan(0.5F * camera.fovY)));
}

Camera lookAt(const glm::vec3& eye, const glm::vec3& target, const Aabb& sceneWorld) {
  const glm::vec3 direction = target - eye;
  if (!(glm::length(direction) > 0.0F)) throw Error(ErrorCode::kUsage, "the eye and the point it looks at must differ");
  const bool vertical = std::abs(glm::normalize(direction).y) > 0.9999F;
  const glm::vec3 up = vertical ? glm::vec3(0.0F, 0.0F, -1.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
  Camera camera;
  camera.worldFromCamera = glm::inverse(glm::lookAt(eye, target, up));
  camera.zNear = nearPlaneFor(sceneWorld);
  return camera;
}

Camera frameBox(const Aabb& sceneWorld, float aspect) {
  if (sceneWorld.empty() || !(sceneWorld.diagonal() > 0.0F)) {
    const Aabb unit{glm::vec3(-1.0F), glm::vec3(1.0F)};
    return lookAt(glm::vec3(0.0F, 0.0F, 4.0F), glm::vec3(0.0F), unit);
  }
  const glm::vec3 towardsEye = glm::normalize(glm::vec3(0.35F, 0.4F, 1.0F));
  const glm::vec3 center = sceneWorld.center();
  // Far from the origin rounding swallows the step: only the direction matters, the place is set below.
  const bool lost = glm::length(center + towardsEye - center - towardsEye) > 1e-3F;
  Camera camera =
      lost ? lookAt(towardsEye, glm::vec3(0.0F), sceneWorld) : lookAt(center + towardsEye, center, sceneWorld);
  const float tanY = std::tan(0.5F * camera.fovY);
  const glm::mat3 cameraFromWorld = glm::transpose(glm::mat3(camera.worldFromCamera));
  // The distance at which the last of the eight corners enters the view.
  float distance = 0.0F;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 sign((corner & 1) != 0 ? 1.0F : -1.0F, (corner & 2) != 0 ? 1.0F : -1.0F,
                         (corner & 4) != 0 ? 1.0F : -1.0F);
    const glm::vec3 p = cameraFromWorld * (0.5F * sign * sceneWorld.extent());
    distance = std::max({distance, p.z + std::abs(p.y) / tanY, p.z + std::abs(p.x) / (tanY * aspect)});
  }
  camera.worldFromCamera[3] = glm::vec4(center + 1.03F * distance * towardsEye, 1.0F);
  return camera;
}

Camera cameraAtFrame(const asset::Camera& recorded, float frame) {
  Camera camera;
  camera.fovY = recorded.fovY;
  camera.halfSize = recorded.halfSize;
  camera.zNear = recorded.zNear;
  camera.zFar = recorded.zFar;
  camera.worldFromCamera = glm::mat4(recorded.worldFromCamera);
  const asset::CameraTrack& track = recorded.track;
  if (track.translations.empty() && track.rotations.empty()) return camera;

  const float seconds = frame / kPathRate;
  const glm::mat4 parentFromCamera(glm::inverse(recorded.worldFromParent) * recorded.worldFromCamera);
  glm::vec3 translation(parentFromCamera[3]);
  glm::quat rotation = glm::quat_cast(glm::mat3(parentFromCamera));
  if (!track.translations.empty()) {
    const KeySpan keys = findKeys(track.translationTimes, seconds);
    translation = glm::mix(track.translations[keys.first], track.translations[keys.second], keys.weight);
  }
  if (!track.rotations.empty()) {
    const KeySpan keys = findKeys(track.rotationTimes, seconds);
    rotation = glm::normalize(glm::slerp(track.rotations[keys.first], track.rotations[keys.second], keys.weight));
  }
  const glm::mat4 moved = glm::translate(glm::mat4(1.0F), translation) * glm::mat4_cast(rotation);
  camera.worldFromCamera = glm::mat4(recorded.worldFromParent * glm::dmat4(moved));
  return camera;
}

std::uint32_t frameCount(const asset::Camera& recorded) {
  float last = 0.0F;
  if (!recorded.track.translationTimes.empty()) last = std::max(last, recorded.track.translationTimes.back());
  if (!recorded.track.rotationTimes.empty()) last = std::max(last, recorded.track.rotationTimes.back());
  return frameCount(last);
}

std::uint32_t frameCount(float seconds) {
  constexpr float kMostFrames = 1e9F;
  return static_cast<std::uint32_t>(std::clamp(std::floor(seconds * kPathRate + 0.5F), 0.0F, kMostFrames)) + 1;
}

}  // namespace jalousie::scene
