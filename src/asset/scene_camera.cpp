// Perspective cameras and their tracks.
#include "asset/scene_camera.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <utility>

#include "asset/accessor.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

constexpr double kPi = 3.14159265358979323846;

[[noreturn]] void malformed(const std::string& message) {
  throw Error(ErrorCode::kMalformed, message);
}

/// Keys of one channel: times ascending, one value each.
template <class Value>
struct Keys {
  std::vector<float> times;
  std::vector<Value> values;
};

/// STEP holds a value until the next key: doubling the keys says the same in linear terms.
template <class Value>
Keys<Value> doubled(const Keys<Value>& keys) {
  Keys<Value> result;
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    if (i > 0) {
      result.times.push_back(keys.times[i]);
      result.values.push_back(keys.values[i - 1]);
    }
    result.times.push_back(keys.times[i]);
    result.values.push_back(keys.values[i]);
  }
  return result;
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

template <class Value, class Read>
Keys<Value> readKeys(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, const Limits& limits,
                     const Read& read) {
  const std::uint64_t maxElements = limits.maxAccessorElements;
  Keys<Value> keys{readScalars(model, sampler.input, maxElements), {}};
  checkTimes(keys.times);
  const bool cubic = sampler.interpolation == "CUBICSPLINE";
  std::vector<Value> values = read(model, sampler.output, maxElements, cubic);
  keys.values = cubic ? middleOfThree(values) : std::move(values);
  if (keys.times.size() != keys.values.size()) malformed("animation has different numbers of times and values");
  return sampler.interpolation == "STEP" ? doubled(keys) : keys;
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

/// The first channel of any animation that moves the node counts, separately for translation and rotation.
CameraTrack readTrack(const tinygltf::Model& model, int node, const Limits& limits) {
  CameraTrack track;
  for (const tinygltf::Animation& animation : model.animations) {
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      if (channel.target_node != node) continue;
      const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
      if (channel.target_path == "translation" && track.translations.empty()) {
        auto keys = readKeys<glm::vec3>(model, sampler, limits, readTranslations);
        track.translationTimes = std::move(keys.times);
        track.translations = std::move(keys.values);
      } else if (channel.target_path == "rotation" && track.rotations.empty()) {
        auto keys = readKeys<glm::quat>(model, sampler, limits, readRotations);
        track.rotationTimes = std::move(keys.times);
        track.rotations = std::move(keys.values);
      }
    }
  }
  return track;
}

}  // namespace

std::optional<Camera> readCamera(const tinygltf::Model& model, int node, const glm::dmat4& worldFromParent,
                                 const glm::dmat4& worldFromNode, const Limits& limits) {
  const int index = model.nodes[static_cast<std::size_t>(node)].camera;
  const tinygltf::Camera& source = model.cameras[static_cast<std::size_t>(index)];
  if (source.type != "perspective") return std::nullopt;
  const tinygltf::PerspectiveCamera& lens = source.perspective;
  if (!(lens.yfov > 0.0 && lens.yfov < kPi)) malformed(fmt::format("camera {}: yfov {}", index, lens.yfov));
  if (!(static_cast<float>(lens.znear) > 0.0F)) malformed(fmt::format("camera {}: znear {}", index, lens.znear));
  if (lens.zfar != 0.0 && !(static_cast<float>(lens.zfar) > static_cast<float>(lens.znear)))
    malformed(fmt::format("camera {}: zfar {} is not beyond znear {}", index, lens.zfar, lens.znear));

  Camera camera;
  camera.name = source.name.empty() ? model.nodes[static_cast<std::size_t>(node)].name : source.name;
  camera.fovY = static_cast<float>(lens.yfov);
  camera.zNear = static_cast<float>(lens.znear);
  if (lens.zfar > 0.0) camera.zFar = static_cast<float>(lens.zfar);
  camera.worldFromCamera = glm::mat4(worldFromNode);
  camera.worldFromParent = glm::mat4(worldFromParent);
  camera.track = readTrack(model, node, limits);
  return camera;
}

}  // namespace jalousie::asset::detail
