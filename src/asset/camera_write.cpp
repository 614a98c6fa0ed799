// Camera, node, animation.
#include "asset/camera_write.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "asset/accessor.h"
#include "core/check.h"

namespace jalousie::asset {
namespace {

void addAnimation(tinygltf::Model& model, const std::string& name, int node, const CameraTrack& track) {
  tinygltf::Animation animation;
  animation.name = name;
  const auto addChannel = [&](const char* target, int input, int output) {
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    sampler.interpolation = "LINEAR";
    animation.samplers.push_back(std::move(sampler));
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size()) - 1;
    channel.target_node = node;
    channel.target_path = target;
    animation.channels.push_back(std::move(channel));
  };
  int input = -1;
  if (!track.translations.empty()) {
    input = appendScalars(model, track.translationTimes, 0);
    addChannel("translation", input, appendVec3(model, track.translations, 0));
  }
  if (!track.rotations.empty()) {
    if (input < 0 || track.rotationTimes != track.translationTimes)
      input = appendScalars(model, track.rotationTimes, 0);
    addChannel("rotation", input, appendQuaternions(model, track.rotations, 0));
  }
  if (!animation.channels.empty()) model.animations.push_back(std::move(animation));
}

}  // namespace

int appendCamera(tinygltf::Model& model, const std::string& name, const Camera& camera) {
  const glm::dvec3 start(camera.worldFromParent[3]);
  JAL_CHECK(!camera.halfSize.has_value());
  JAL_CHECK((camera.worldFromParent == glm::translate(glm::dmat4(1.0), start)));
  tinygltf::Camera target;
  target.type = "perspective";
  target.name = name;
  target.perspective.yfov = static_cast<double>(camera.fovY);
  target.perspective.znear = static_cast<double>(camera.zNear);
  if (camera.zFar) target.perspective.zfar = static_cast<double>(*camera.zFar);
  model.cameras.push_back(std::move(target));

  const CameraTrack& track = camera.track;
  const glm::vec3 position =
      track.translations.empty() ? glm::vec3(glm::dvec3(camera.worldFromCamera[3]) - start) : track.translations[0];
  const glm::quat rotation =
      track.rotations.empty() ? glm::quat_cast(glm::mat3(glm::mat4(camera.worldFromCamera))) : track.rotations[0];
  tinygltf::Node node;
  node.name = "camera";
  node.camera = static_cast<int>(model.cameras.size()) - 1;
  node.translation = {position.x, position.y, position.z};
  node.rotation = {rotation.x, rotation.y, rotation.z, rotation.w};
  model.nodes.push_back(std::move(node));
  const int index = static_cast<int>(model.nodes.size()) - 1;
  addAnimation(model, name, index, track);
  if (start == glm::dvec3(0.0)) return index;
  tinygltf::Node above;
  above.name = "start";
  above.translation = {start.x, start.y, start.z};
  above.children = {index};
  model.nodes.push_back(std::move(above));
  return index + 1;
}

}  // namespace jalousie::asset
