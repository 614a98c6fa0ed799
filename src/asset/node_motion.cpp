// Interpolates keys.
#include "asset/node_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <span>

#include "asset/accessor.h"
#include "asset/node_graph.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

template <class Vector>
std::vector<float> flat(const std::vector<Vector>& values) {
  std::vector<float> numbers;
  numbers.reserve(values.size() * static_cast<std::size_t>(Vector::length()));
  for (const Vector& value : values)
    for (int i = 0; i < Vector::length(); ++i)
      numbers.push_back(value[i]);
  return numbers;
}

glm::dquat quaternion(std::span<const double> xyzw) {
  return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

std::vector<double> numbers(const glm::dquat& q) {
  return {q.x, q.y, q.z, q.w};
}

std::vector<double> normalized(std::vector<double> quaternion) {
  double length = 0.0;
  for (const double x : quaternion)
    length += x * x;
  length = std::sqrt(length);
  if (!(length > 0.0) || !std::isfinite(length))
    throw Error(ErrorCode::kMalformed, "an animated rotation has no direction");
  for (double& x : quaternion)
    x /= length;
  return quaternion;
}

/// The keys around a time.
struct Between {
  std::size_t first;
  std::size_t second;
  double share;   ///< of the second, 0 to 1
  double length;  ///< seconds between them
};

Between between(const std::vector<float>& times, double seconds) {
  const auto upper = std::upper_bound(times.begin(), times.end(), seconds,
                                      [](double time, float key) { return time < static_cast<double>(key); });
  if (upper == times.begin()) return {0, 0, 0.0, 0.0};
  const std::size_t last = times.size() - 1;
  if (upper == times.end()) return {last, last, 0.0, 0.0};
  const auto second = static_cast<std::size_t>(upper - times.begin());
  const double start = static_cast<double>(times[second - 1]);
  const double length = static_cast<double>(times[second]) - start;
  return {second - 1, second, length > 0.0 ? (seconds - start) / length : 0.0, length};
}

}  // namespace

void requireAscending(const std::vector<float>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
      throw Error(ErrorCode::kMalformed, "animation times must be finite and ascend");
  }
}

NodeMotion::NodeMotion(const tinygltf::Model& model, const Limits& limits) : model_(model), limits_(limits) {
  for (const tinygltf::Animation& animation : model.animations) {
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      if (channel.target_node < 0) continue;
      samplers_.try_emplace({channel.target_node, channel.target_path},
                            &animation.samplers[static_cast<std::size_t>(channel.sampler)]);
    }
  }
}

const tinygltf::AnimationSampler* NodeMotion::samplerOf(int node, const std::string& property) const {
  const auto found = samplers_.find({node, property});
  return found == samplers_.end() ? nullptr : found->second;
}

bool NodeMotion::moves(int node) const {
  const auto isMoved = [&](const char* property) { return samplerOf(node, property) != nullptr; };
  return isMoved("translation") || isMoved("rotation") || isMoved("scale");
}

const MotionKeys& NodeMotion::keysOf(const tinygltf::AnimationSampler& sampler, const std::string& property) {
  const auto [place, isNew] = keys_.try_emplace({&sampler, property});
  MotionKeys& keys = place->second;
  if (!isNew) return keys;
  const std::uint64_t most = limits_.maxAccessorElements;
  keys.times = readScalars(model_, sampler.input, most);
  if (property == "weights")
    keys.values = readScalars(model_, sampler.output, most);
  else if (property == "rotation")
    keys.values = flat(readVec4(model_, sampler.output, most));
  else
    keys.values = flat(readVec3(model_, sampler.output, most));
  const std::size_t perKey = sampler.interpolation == "CUBICSPLINE" ? 3 : 1;
  const auto finite = [](float value) { return std::isfinite(value); };
  if (keys.times.empty() || keys.values.size() % (keys.times.size() * perKey) != 0 || keys.values.empty() ||
      !std::all_of(keys.values.begin(), keys.values.end(), finite))
    throw Error(ErrorCode::kMalformed, "an animation's times and values do not fit together");
  requireAscending(keys.times);
  keys.width = keys.values.size() / (keys.times.size() * perKey);
  const std::size_t expected = property == "rotation" ? 4 : property == "weights" ? keys.width : 3;
  if (keys.width != expected)
    throw Error(ErrorCode::kMalformed, "an animation has different numbers of times and values");
  return keys;
}

float NodeMotion::lastKey(int node) {
  float last = 0.0F;
  for (const char* property : {"translation", "rotation", "scale"})
    if (const tinygltf::AnimationSampler* sampler = samplerOf(node, property))
      last = std::max(last, keysOf(*sampler, property).times.back());
  return last;
}

std::vector<double> NodeMotion::valueAt(int node, const std::string& property, double seconds) {
  const tinygltf::AnimationSampler* sampler = samplerOf(node, property);
  if (sampler == nullptr) return {};
  const MotionKeys& keys = keysOf(*sampler, property);
  const bool cubic = sampler->interpolation == "CUBICSPLINE";
  const bool turns = property == "rotation";
  const Between at = between(keys.times, seconds);
  // Of the values of a key: 0 the in-tangent, 1 the value, 2 the out-tangent of a spline.
  const auto part = [&](std::size_t key, std::size_t which) {
    const std::size_t first = (cubic ? 3 * key + which : key) * keys.width;
    return std::vector<double>(keys.values.begin() + static_cast<std::ptrdiff_t>(first),
                               keys.values.begin() + static_cast<std::ptrdiff_t>(first + keys.width));
  };
  std::vector<double> value = part(at.first, 1);
  if (at.first == at.second || sampler->interpolation == "STEP") return turns ? normalized(std::move(value)) : value;
  const std::vector<double> next = part(at.second, 1);
  const double t = at.share;
  if (cubic) {
    const std::vector<double> leaving = part(at.first, 2);
    const std::vector<double> arriving = part(at.second, 0);
    for (std::size_t i = 0; i < keys.width; ++i)
      value[i] = (2.0 * t * t * t - 3.0 * t * t + 1.0) * value[i] +
                 at.length * (t * t * t - 2.0 * t * t + t) * leaving[i] + (3.0 * t * t - 2.0 * t * t * t) * next[i] +
                 at.length * (t * t * t - t * t) * arriving[i];
    return turns ? normalized(std::move(value)) : value;
  }
  if (turns)
    return numbers(
        glm::normalize(glm::slerp(quaternion(normalized(std::move(value))), quaternion(normalized(next)), t)));
  for (std::size_t i = 0; i < keys.width; ++i)
    value[i] += (next[i] - value[i]) * t;
  return value;
}

glm::dmat4 NodeMotion::transformAt(int node, double seconds) {
  tinygltf::Node posed;
  const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
  if (!moves(node)) return localTransform(source);
  const auto property = [&](const char* name, const std::vector<double>& fallback) {
    std::vector<double> value = valueAt(node, name, seconds);
    return value.empty() ? fallback : value;
  };
  posed.translation = property("translation", source.translation);
  posed.rotation = property("rotation", source.rotation);
  posed.scale = property("scale", source.scale);
  return localTransform(posed);
}

std::vector<double> NodeMotion::restWeights(int node) const {
  const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
  if (source.mesh < 0) return {};
  const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(source.mesh)];
  std::size_t targets = 0;
  for (const tinygltf::Primitive& primitive : mesh.primitives)
    targets = std::max(targets, primitive.targets.size());
  std::vector<double> weights = source.weights.empty() ? mesh.weights : source.weights;
  weights.resize(targets, 0.0);
  return weights;
}

std::vector<double> NodeMotion::weightsAt(int node, double seconds) {
  std::vector<double> rest = restWeights(node);
  std::vector<double> weights = valueAt(node, "weights", seconds);
  if (weights.empty()) return rest;
  weights.resize(rest.size(), 0.0);
  return weights;
}

}  // namespace jalousie::asset
