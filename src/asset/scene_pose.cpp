// Transforms of all nodes at a time, and of the joints of skins.
#include "asset/scene_pose.h"

#include <algorithm>
#include <utility>

#include "asset/accessor.h"
#include "asset/node_graph.h"
#include "core/error.h"

namespace jalousie::asset::detail {

std::vector<glm::dmat4> inverseBindMatrices(const tinygltf::Model& model, const tinygltf::Skin& skin) {
  std::vector<glm::dmat4> matrices(skin.joints.size(), glm::dmat4(1.0));
  if (skin.inverseBindMatrices < 0) return matrices;
  std::size_t at = 0;
  visitComponents(model, skin.inverseBindMatrices, [&](float value) {
    const std::size_t matrix = at / 16;
    if (matrix < matrices.size())
      matrices[matrix][static_cast<glm::length_t>(at % 16 / 4)][static_cast<glm::length_t>(at % 4)] = value;
    ++at;
  });
  return matrices;
}

ScenePose::ScenePose(const tinygltf::Model& model, NodeMotion& motion, std::optional<double> seconds)
    : model_(model), seconds_(seconds), motion_(motion) {}

glm::dmat4 ScenePose::localTransform(int node) {
  return seconds_ ? motion_.transformAt(node, *seconds_)
                  : asset::localTransform(model_.nodes[static_cast<std::size_t>(node)]);
}

const std::vector<glm::dmat4>& ScenePose::worldFromNodes() {
  if (!worldFromNodes_.empty()) return worldFromNodes_;
  worldFromNodes_.assign(model_.nodes.size(), glm::dmat4(1.0));
  std::vector<std::uint8_t> isChild(model_.nodes.size(), 0);
  for (const tinygltf::Node& node : model_.nodes)
    for (const int child : node.children)
      isChild[static_cast<std::size_t>(child)] = 1;
  std::vector<std::pair<int, glm::dmat4>> stack;
  for (std::size_t node = 0; node < isChild.size(); ++node)
    if (isChild[node] == 0) stack.emplace_back(static_cast<int>(node), glm::dmat4(1.0));
  while (!stack.empty()) {
    const auto [node, worldFromParent] = stack.back();
    stack.pop_back();
    const glm::dmat4 world = worldFromParent * localTransform(node);
    worldFromNodes_[static_cast<std::size_t>(node)] = world;
    for (const int child : model_.nodes[static_cast<std::size_t>(node)].children)
      stack.emplace_back(child, world);
  }
  return worldFromNodes_;
}

MeshPose ScenePose::meshPose(int node) {
  MeshPose pose;
  const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
  pose.weights = seconds_ ? motion_.weightsAt(node, *seconds_) : motion_.restWeights(node);
  if (source.skin < 0) return pose;
  const tinygltf::Skin& skin = model_.skins[static_cast<std::size_t>(source.skin)];
  pose.worldFromMesh = inverseBindMatrices(model_, skin);
  for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
    glm::dmat4& matrix = pose.worldFromMesh[joint];
    matrix = worldFromNodes()[static_cast<std::size_t>(skin.joints[joint])] * matrix;
    if (!isFinite(matrix)) throw Error(ErrorCode::kMalformed, "a joint's transform is not finite");
  }
  return pose;
}

}  // namespace jalousie::asset::detail
