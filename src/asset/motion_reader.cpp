// Chains of nodes that rest are folded into one matrix, in double precision.
#include "asset/motion_reader.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "asset/node_graph.h"
#include "asset/scene_pose.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

/// Moving nodes one above another: each costs a product of matrices for each target below it in every frame.
constexpr std::uint32_t kDeepest = 1024;
/// Times at which the largest scale of a skin is looked for.
constexpr int kScaleSamples = 64;

glm::vec4 row(const glm::dmat4& matrix, int i) {
  return {matrix[0][i], matrix[1][i], matrix[2][i], matrix[3][i]};
}

gpu::MotionTarget targetOf(const glm::dmat4& nodeFromTarget, std::uint32_t node, std::uint32_t destination) {
  if (!isFinite(nodeFromTarget))
    throw Error(ErrorCode::kMalformed, "the transform of what an animation moves is not finite");
  return {row(nodeFromTarget, 0), row(nodeFromTarget, 1), row(nodeFromTarget, 2), node, destination, 0, 0};
}

glm::vec4 vectorOf(const std::vector<double>& values, const glm::vec4& fallback) {
  glm::vec4 result = fallback;
  for (std::size_t i = 0; i < values.size() && i < 4; ++i)
    result[static_cast<glm::length_t>(i)] = static_cast<float>(values[i]);
  return result;
}

std::uint32_t interpolationOf(const tinygltf::AnimationSampler& sampler) {
  if (sampler.interpolation == "STEP") return gpu::kMotionStep;
  return sampler.interpolation == "CUBICSPLINE" ? gpu::kMotionCubic : gpu::kMotionLinear;
}

void shift(glm::dmat4& worldFromLocal, const glm::dvec3& originWorld) {
  worldFromLocal[3] -= glm::dvec4(originWorld, 0.0);
}

}  // namespace

MotionReader::MotionReader(const tinygltf::Model& model, NodeMotion& motion)
    : model_(model), motion_(motion), parents_(parentsOf(model)), anchors_(model.nodes.size()) {}

const MotionReader::Anchor& MotionReader::anchorOf(int node) {
  std::vector<int> unknown;  // from the node upwards
  int above = node;
  for (; above >= 0 && !anchors_[static_cast<std::size_t>(above)]; above = parents_[static_cast<std::size_t>(above)])
    unknown.push_back(above);
  while (!unknown.empty()) {
    const int next = unknown.back();
    unknown.pop_back();
    const Anchor parent = above >= 0 ? *anchors_[static_cast<std::size_t>(above)] : Anchor{};
    Anchor& anchor = anchors_[static_cast<std::size_t>(next)].emplace();
    if (motion_.moves(next)) {
      anchor.node = addNode(next, parent);
    } else {
      anchor = {parent.node, parent.anchorFromNode * localTransform(model_.nodes[static_cast<std::size_t>(next)])};
    }
    above = next;
  }
  return *anchors_[static_cast<std::size_t>(node)];
}

std::uint32_t MotionReader::addNode(int node, const Anchor& parent) {
  const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
  if (!isFinite(parent.anchorFromNode))
    throw Error(ErrorCode::kMalformed, "the transform of what an animation moves is not finite");
  const std::uint32_t depth = parent.node == gpu::kNoMotion ? 1 : depths_[parent.node] + 1;
  if (depth > kDeepest) throw Error(ErrorCode::kLimit, "more than 1024 animated nodes lie one below another");
  gpu::MotionNode result{};
  result.translation = vectorOf(source.translation, glm::vec4(0.0F));
  result.rotation = vectorOf(source.rotation, glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));
  const float length = glm::length(result.rotation);
  if (!(length > 0.0F)) throw Error(ErrorCode::kMalformed, "a rotation has no direction");
  result.rotation /= length;
  result.scale = vectorOf(source.scale, glm::vec4(1.0F));
  result.anchor = parent.node;
  result.translationTrack = trackOf(node, "translation");
  result.rotationTrack = trackOf(node, "rotation");
  result.scaleTrack = trackOf(node, "scale");
  result_.nodes.push_back(result);
  depths_.push_back(depth);
  anchorFromParents_.push_back(parent.anchorFromNode);
  return static_cast<std::uint32_t>(result_.nodes.size() - 1);
}

std::uint32_t MotionReader::trackOf(int node, const std::string& property) {
  const tinygltf::AnimationSampler* sampler = motion_.samplerOf(node, property);
  if (sampler == nullptr) return gpu::kNoMotion;
  const auto [place, isNew] =
      tracks_.try_emplace({sampler, property}, static_cast<std::uint32_t>(result_.tracks.size()));
  if (!isNew) return place->second;
  const MotionKeys keys = motion_.keysOf(*sampler, property);
  const std::size_t first = result_.numbers.size();
  if (first + keys.times.size() + keys.values.size() > 0xFFFFFFFFULL)
    throw Error(ErrorCode::kLimit, "the scene's animations have too many keys");
  result_.numbers.insert(result_.numbers.end(), keys.times.begin(), keys.times.end());
  result_.numbers.insert(result_.numbers.end(), keys.values.begin(), keys.values.end());
  result_.tracks.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(keys.times.size()),
                            static_cast<std::uint32_t>(first + keys.times.size()),
                            static_cast<std::uint32_t>(keys.width), interpolationOf(*sampler)});
  result_.lastKey = std::max(result_.lastKey, keys.times.back());
  return place->second;
}

std::optional<Follower> MotionReader::follower(std::uint32_t index, int node, const glm::dmat4& nodeFromTarget) {
  const Anchor& anchor = anchorOf(node);
  if (anchor.node == gpu::kNoMotion) return std::nullopt;
  return Follower{index, targetOf(anchor.anchorFromNode * nodeFromTarget, anchor.node, 0)};
}

void MotionReader::addInstance(std::uint32_t instance, int node, const glm::dmat4& nodeFromInstance) {
  if (const auto follows = follower(instance, node, nodeFromInstance)) result_.instances.push_back(*follows);
}

void MotionReader::addLooseInstance(std::uint32_t instance, int node, const glm::dmat4& nodeFromInstance) {
  if (const auto follows = follower(instance, node, nodeFromInstance)) result_.looseInstances.push_back(*follows);
}

bool MotionReader::hasMovingJoints(int skin) {
  const auto [place, isNew] = movingSkins_.try_emplace(skin, false);
  if (!isNew) return place->second;
  const std::vector<int>& joints = model_.skins[static_cast<std::size_t>(skin)].joints;
  place->second =
      std::any_of(joints.begin(), joints.end(), [&](int joint) { return anchorOf(joint).node != gpu::kNoMotion; });
  return place->second;
}

bool MotionReader::bends(int node) {
  const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
  if (source.skin >= 0 && hasMovingJoints(source.skin)) return true;
  return motion_.samplerOf(node, "weights") != nullptr && !motion_.restWeights(node).empty();
}

std::uint32_t MotionReader::firstJoint(int skin) {
  const auto [place, isNew] = joints_.try_emplace(skin, static_cast<std::uint32_t>(result_.joints.size()));
  if (!isNew) return place->second;
  const tinygltf::Skin& source = model_.skins[static_cast<std::size_t>(skin)];
  const std::vector<glm::dmat4> inverseBind = inverseBindMatrices(model_, source);
  for (std::size_t joint = 0; joint < source.joints.size(); ++joint) {
    const Anchor& anchor = anchorOf(source.joints[joint]);
    targetsOfJoints_.push_back(anchor.anchorFromNode * inverseBind[joint]);
    result_.joints.push_back(
        targetOf(targetsOfJoints_.back(), anchor.node, static_cast<std::uint32_t>(result_.joints.size())));
  }
  return place->second;
}

std::uint32_t MotionReader::firstWeight(int node) {
  const auto [place, isNew] = weights_.try_emplace(node, static_cast<std::uint32_t>(result_.weights.size()));
  if (!isNew) return place->second;
  const std::vector<double> rest = motion_.restWeights(node);
  const std::uint32_t track = trackOf(node, "weights");
  const std::uint32_t width = track == gpu::kNoMotion ? 0 : result_.tracks[track].width;
  for (std::uint32_t target = 0; target < rest.size(); ++target) {
    // Targets beyond those of a track weigh nothing, as in NodeMotion::weightsAt.
    const bool isMoved = target < width;
    const float weight = track == gpu::kNoMotion ? static_cast<float>(rest[target]) : 0.0F;
    result_.weights.push_back({isMoved ? track : gpu::kNoMotion, target, weight});
  }
  return place->second;
}

BendingTables MotionReader::tablesOf(int node) {
  const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
  BendingTables tables;
  if (source.skin >= 0) {
    tables.firstJoint = firstJoint(source.skin);
    tables.joints = static_cast<std::uint32_t>(model_.skins[static_cast<std::size_t>(source.skin)].joints.size());
  }
  tables.firstWeight = firstWeight(node);
  return tables;
}

double MotionReader::largestScale(int node) {
  double largest = 0.0;
  for (int i = 0; i <= kScaleSamples; ++i) {
    const double seconds = static_cast<double>(result_.lastKey) * i / kScaleSamples;
    largest = std::max(largest, ScenePose(model_, motion_, seconds).meshPose(node).largestScale());
  }
  return largest;
}

SceneMotion MotionReader::take(const glm::dvec3& originWorld) {
  for (std::size_t n = 0; n < result_.nodes.size(); ++n) {
    gpu::MotionNode& node = result_.nodes[n];
    glm::dmat4 matrix = anchorFromParents_[n];
    if (node.anchor == gpu::kNoMotion) shift(matrix, originWorld);
    node.anchorFromParent0 = row(matrix, 0);
    node.anchorFromParent1 = row(matrix, 1);
    node.anchorFromParent2 = row(matrix, 2);
  }
  for (std::size_t j = 0; j < result_.joints.size(); ++j) {
    gpu::MotionTarget& joint = result_.joints[j];
    if (joint.node != gpu::kNoMotion) continue;
    shift(targetsOfJoints_[j], originWorld);
    joint = targetOf(targetsOfJoints_[j], joint.node, joint.destination);
  }
  return std::move(result_);
}

}  // namespace jalousie::asset::detail
