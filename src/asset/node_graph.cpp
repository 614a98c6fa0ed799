// Matrix or translation, rotation and scale of a node; the roots of a scene.
#include "asset/node_graph.h"

#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "asset/lod_chain.h"
#include "core/error.h"

namespace jalousie::asset {

glm::dmat4 localTransform(const tinygltf::Node& node) {
  glm::dmat4 local(1.0);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i)
      local[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return local;
  }
  if (node.translation.size() == 3)
    local = glm::translate(local, glm::dvec3(node.translation[0], node.translation[1], node.translation[2]));
  if (node.rotation.size() == 4) {
    const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(q);
    if (!(length > 0.0) || !std::isfinite(length))
      throw Error(ErrorCode::kMalformed, "a node's rotation has no direction");
    local *= glm::mat4_cast(q / length);
  }
  if (node.scale.size() == 3) local = glm::scale(local, glm::dvec3(node.scale[0], node.scale[1], node.scale[2]));
  return local;
}

bool isFinite(const glm::dmat4& transform) {
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(static_cast<float>(transform[i / 4][i % 4]))) return false;
  return true;
}

namespace {

/// The nodes that a scene lists, without those that lie below others of them.
std::vector<int> withoutDescendants(const tinygltf::Model& model, const tinygltf::Scene& scene) {
  std::vector<int> stack = scene.nodes;
  std::vector<std::uint8_t> isBelow(model.nodes.size(), 0);
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    for (const int child : model.nodes[static_cast<std::size_t>(node)].children)
      if (isBelow[static_cast<std::size_t>(child)]++ == 0) stack.push_back(child);
  }
  std::vector<int> roots = scene.nodes;
  std::erase_if(roots, [&](int root) { return isBelow[static_cast<std::size_t>(root)] != 0; });
  return roots;
}

}  // namespace

std::vector<int> parentsOf(const tinygltf::Model& model) {
  std::vector<int> parents(model.nodes.size(), -1);
  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    for (const int child : model.nodes[node].children)
      parents[static_cast<std::size_t>(child)] = static_cast<int>(node);
  }
  return parents;
}

std::vector<int> sceneRoots(const tinygltf::Model& model) {
  if (!model.scenes.empty())
    return withoutDescendants(model,
                              model.scenes[static_cast<std::size_t>(model.defaultScene >= 0 ? model.defaultScene : 0)]);
  std::vector<std::uint8_t> excluded(model.nodes.size(), 0);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const int child : model.nodes[i].children)
      excluded[static_cast<std::size_t>(child)] = 1;
    for (const int level : lodIds(model, static_cast<int>(i)))
      excluded[static_cast<std::size_t>(level)] = 1;
    const int empty = emptyLevel(model, static_cast<int>(i));
    if (empty >= 0) excluded[static_cast<std::size_t>(empty)] = 1;
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < excluded.size(); ++i) {
    if (excluded[i] == 0) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

}  // namespace jalousie::asset
