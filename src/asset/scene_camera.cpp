// Perspective cameras and their tracks.
#include "asset/scene_camera.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <utility>

#include "asset/accessor.h"
#include "asset/camera_validate.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

[[noreturn]] void malformed(const std::string& message) {
  throw Error(ErrorCode::kMalformed, message);
}

/// STEP holds a value until the next key: doubling the keys says the same in linear terms.
template <class Value>
void doubleKeys(std::vector<float>& times, std::vector<Value>& values) {
  if (times.empty()) return;
  const std::size_t count = times.size();
  times.resize(2 * count - 1);
  values.resize(2 * count - 1);
  for (std::size_t i = count; i-- > 1;) {
    times[2 * i] = times[2 * i - 1] = times[i];
    values[2 * i] = values[i];
    values[2 * i - 1] = values[i - 1];
  }
}

/// CUBICSPLINE stores in-tangent, value, out-tangent per key; the values stay.
template <class Value>
std::vector<Value> middleOfThree(const std::vector<Value>& values) {
  std::vector<Value> result;
  for (std::size_t i = 1; i < values.size(); i += 3)
    result.push_back(values[i]);
  return result;
}

void checkTimes(const std::vector<float>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
      malformed("animation times must be finite and ascend");
  }
}

std::vector<glm::vec3> readTranslations(const tinygltf::Model& model, int accessor, std::uint64_t maxElements, bool) {
  std::vector<glm::vec3> values = readVec3(model, accessor, maxElements);
  for (const glm::vec3& v : values) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) malformed("animation is not finite");
  }
  return values;
}

/// Tangents of a spline are no rotations: they may be zero, so they must not be normalised.
std::vector<glm::quat> readRotations(const tinygltf::Model& model, int accessor, std::uint64_t maxElements,
                                     bool cubic) {
  if (!cubic) return readQuaternions(model, accessor, maxElements);
  std::vector<glm::quat> values;
  for (const glm::vec4& v : readVec4(model, accessor, maxElements)) {
    const float length = glm::length(v);
    const bool usable = std::isfinite(length) && length > 0.0F;
    const glm::vec4 unit = usable ? v / length : glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    values.emplace_back(unit.w, unit.x, unit.y, unit.z);
  }
  return values;
}

}  // namespace

CameraReader::CameraReader(const tinygltf::Model& model, const Limits& limits) : model_(model), limits_(limits) {
  for (const tinygltf::Animation& animation : model.animations)
    for (const tinygltf::AnimationChannel& channel : animation.channels)
      channels_[channel.target_node].emplace_back(&animation, &channel);
}

template <class Value, class Read>
const CameraReader::Keys<Value>& CameraReader::keysOf(KeyTable<Value>& table, const tinygltf::AnimationSampler& sampler,
                                                      const Read& read) {
  const auto [place, isNew] = table.try_emplace({sampler.input, sampler.output, sampler.interpolation});
  Keys<Value>& keys = place->second;
  if (!isNew) return keys;
  const std::uint64_t maxElements = limits_.maxAccessorElements;
  std::vector<float> times = readScalars(model_, sampler.input, maxElements);
  checkTimes(times);
  const bool cubic = sampler.interpolation == "CUBICSPLINE";
  std::vector<Value> values = read(model_, sampler.output, maxElements, cubic);
  if (cubic) values = middleOfThree(values);
  if (times.size() != values.size()) malformed("animation has different numbers of times and values");
  if (sampler.interpolation == "STEP") doubleKeys(times, values);
  keys = {std::move(times), std::move(values)};
  return keys;
}

/// The first channel of any animation that moves the node counts, separately for translation and rotation.
CameraTrack CameraReader::trackOf(int node) {
  CameraTrack track;
  const auto found = channels_.find(node);
  if (found == channels_.end()) return track;
  for (const auto& [animation, channel] : found->second) {
    const tinygltf::AnimationSampler& sampler = animation->samplers[static_cast<std::size_t>(channel->sampler)];
    if (channel->target_path == "translation" && track.translations.empty()) {
      const Keys<glm::vec3>& keys = keysOf(positions_, sampler, readTranslations);
      track.translationTimes = keys.times;
      track.translations = keys.values;
    } else if (channel->target_path == "rotation" && track.rotations.empty()) {
      const Keys<glm::quat>& keys = keysOf(rotations_, sampler, readRotations);
      track.rotationTimes = keys.times;
      track.rotations = keys.values;
    }
  }
  return track;
}

std::optional<Camera> CameraReader::read(int node, const glm::dmat4& worldFromParent, const glm::dmat4& worldFromNode) {
  const int index = model_.nodes[static_cast<std::size_t>(node)].camera;
  const tinygltf::Camera& source = model_.cameras[static_cast<std::size_t>(index)];
  validateLens(source, static_cast<std::size_t>(index));
  if (source.type != "perspective") return std::nullopt;
  const tinygltf::PerspectiveCamera& lens = source.perspective;

  Camera camera;
  camera.name = source.name.empty() ? model_.nodes[static_cast<std::size_t>(node)].name : source.name;
  camera.fovY = static_cast<float>(lens.yfov);
  camera.zNear = static_cast<float>(lens.znear);
  if (lens.zfar > 0.0) camera.zFar = static_cast<float>(lens.zfar);
  camera.worldFromCamera = glm::mat4(worldFromNode);
  camera.worldFromParent = glm::mat4(worldFromParent);
  camera.track = trackOf(node);
  return camera;
}

}  // namespace jalousie::asset::detail
