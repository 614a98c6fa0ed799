// Values of skins, animations and instances. Each accessor is looked at once for each use, however many channels share
// it.
#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asset/accessor.h"
#include "asset/accessor_layout.h"
#include "asset/gltf_validate.h"
#include "asset/instancing.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using tinygltf::Model;

/// @param owner  "skin 3", for the message
void requireFinite(const Model& model, int accessor, const std::string& owner) {
  if (!holdsFiniteNumbers(model, accessor))
    malformed(fmt::format("{}: accessor {} holds a number that is not finite", owner, accessor));
}

void checkSkins(const Model& model) {
  std::set<int> checked;
  for (std::size_t i = 0; i < model.skins.size(); ++i) {
    const tinygltf::Skin& skin = model.skins[i];
    if (skin.inverseBindMatrices < 0) continue;
    const tinygltf::Accessor& matrices = accessorAt(model, skin.inverseBindMatrices);
    if (matrices.type != TINYGLTF_TYPE_MAT4 || matrices.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        matrices.count < skin.joints.size())
      malformed(fmt::format("skin {}: accessor {} does not hold a matrix for each of {} joints", i,
                            skin.inverseBindMatrices, skin.joints.size()));
    if (checked.insert(skin.inverseBindMatrices).second)
      requireFinite(model, skin.inverseBindMatrices, fmt::format("skin {}", i));
  }
}

class AnimationCheck {
 public:
  explicit AnimationCheck(const Model& model) : model_(model) {}

  void check(std::size_t index) {
    owner_ = fmt::format("animation {}", index);
    const tinygltf::Animation& animation = model_.animations[index];
    for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
      if (times_.insert(sampler.input).second) checkTimes(sampler.input);
      if (values_.insert(sampler.output).second) requireFinite(model_, sampler.output, owner_);
    }
    for (const tinygltf::AnimationChannel& channel : animation.channels)
      checkChannel(channel, animation.samplers[static_cast<std::size_t>(channel.sampler)]);
  }

 private:
  void checkTimes(int accessor) const {
    if (accessorAt(model_, accessor).type != TINYGLTF_TYPE_SCALAR) malformed(owner_ + ": times are no scalars");
    const std::vector<float> times = readScalars(model_, accessor, accessorAt(model_, accessor).count);
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (!std::isfinite(times[k]) || (k > 0 && !(times[k] > times[k - 1])))
        malformed(fmt::format("{}: times must be finite and ascend, key {} is {:g}", owner_, k, times[k]));
    }
  }

  /// Keys of a channel: one value each, three with CUBICSPLINE; weights have one for each morph target.
  void checkChannel(const tinygltf::AnimationChannel& channel, const tinygltf::AnimationSampler& sampler) {
    const std::uint64_t keys = accessorAt(model_, sampler.input).count;
    const tinygltf::Accessor& output = accessorAt(model_, sampler.output);
    const bool cubic = sampler.interpolation == "CUBICSPLINE";
    const std::uint64_t elements = keys * (cubic ? 3 : 1);
    if (channel.target_path == "pointer") return;  // the extension tells what the values are
    const int type = channel.target_path == "weights"    ? TINYGLTF_TYPE_SCALAR
                     : channel.target_path == "rotation" ? TINYGLTF_TYPE_VEC4
                                                         : TINYGLTF_TYPE_VEC3;
    if (output.type != type)
      malformed(fmt::format("{}: values have the wrong type for {}", owner_, channel.target_path));
    const std::uint64_t targets = channel.target_path == "weights" ? targetsOf(channel, output.count, elements) : 1;
    if (output.count != elements * targets)
      malformed(fmt::format("{}: {} values for {} times", owner_, output.count, keys));
    if (channel.target_path == "rotation" && rotations_.emplace(sampler.output, cubic).second)
      checkRotations(sampler.output, cubic);
  }

  /// Morph targets of the node that a channel of weights moves. Without a node any whole number will do.
  std::uint64_t targetsOf(const tinygltf::AnimationChannel& channel, std::uint64_t values, std::uint64_t keys) const {
    if (channel.target_node < 0) return values / keys;
    const int mesh = model_.nodes[static_cast<std::size_t>(channel.target_node)].mesh;
    const auto* primitives = mesh < 0 ? nullptr : &model_.meshes[static_cast<std::size_t>(mesh)].primitives;
    if (primitives == nullptr || primitives->empty() || primitives->front().targets.empty())
      malformed(fmt::format("{}: weights of node {}, which has no morph targets", owner_, channel.target_node));
    return primitives->front().targets.size();
  }

  /// Rotations have a direction. The tangents of a spline, which stand around each value, need none.
  void checkRotations(int accessor, bool cubic) const {
    const std::vector<glm::vec4> values = readVec4(model_, accessor, accessorAt(model_, accessor).count);
    for (std::size_t k = cubic ? 1 : 0; k < values.size(); k += cubic ? 3 : 1) {
      const float length = glm::length(values[k]);
      if (!std::isfinite(length) || !(length > 0.0F))
        malformed(fmt::format("{}: rotation {} has no direction", owner_, k));
    }
  }

  const Model& model_;
  std::string owner_;  ///< "animation 3", for messages
  std::set<int> times_, values_;
  std::set<std::pair<int, bool>> rotations_;  ///< accessor, whether read as a spline
};

/// Counts, types and numbers of EXT_mesh_gpu_instancing in all nodes.
void checkAllInstances(const Model& model, const Limits& limits) {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!model.nodes[i].extensions.contains("EXT_mesh_gpu_instancing")) continue;
    total += checkInstances(model, static_cast<int>(i), limits);
    if (total > limits.maxInstances)
      throw Error(ErrorCode::kLimit, fmt::format("more than {} instances", limits.maxInstances));
  }
}

}  // namespace

void validateMotion(const Model& model, const Limits& limits) {
  checkSkins(model);
  AnimationCheck animations(model);
  for (std::size_t i = 0; i < model.animations.size(); ++i)
    animations.check(i);
  checkAllInstances(model, limits);
}

}  // namespace jalousie::asset::detail
