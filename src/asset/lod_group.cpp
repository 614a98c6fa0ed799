// Walks below the nodes of levels; levels are told apart by their meshes and by where these are at rest.
#include "asset/lod_group.h"

#include <cmath>
#include <utility>

#include "asset/lod_chain.h"
#include "asset/node_graph.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

MatrixNumbers numbersOf(const glm::dmat4& matrix) {
  MatrixNumbers numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = matrix[static_cast<glm::length_t>(i / 4)][static_cast<glm::length_t>(i % 4)];
  return numbers;
}

/// Visits a node and all nodes below it, parents first, children in their order.
/// @param visit  called with a node, its rootFromNode and the nearest moved node of it and those above, -1 without
template <class Visit>
void walk(const tinygltf::Model& model, int root, const std::set<int>& moved, const LocalTransform& local,
          const Visit& visit) {
  struct Step {
    int node;
    glm::dmat4 rootFromParent;
    int movedBy;
  };
  std::vector<Step> stack = {{root, glm::dmat4(1.0), -1}};
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    const bool isRoot = step.node == root;
    const glm::dmat4 rootFromNode = isRoot ? step.rootFromParent : step.rootFromParent * local(step.node);
    const int movedBy = !isRoot && moved.contains(step.node) ? step.node : step.movedBy;
    visit(step.node, rootFromNode, movedBy);
    const std::vector<int>& children = model.nodes[static_cast<std::size_t>(step.node)].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      stack.push_back({*child, rootFromNode, movedBy});
  }
}

}  // namespace

LodGroups::LodGroups(const tinygltf::Model& model) : model_(model) {
  for (const tinygltf::Animation& animation : model.animations)
    for (const tinygltf::AnimationChannel& channel : animation.channels)
      if (channel.target_node >= 0) moved_.insert(channel.target_node);
}

LodGroups::PartKey LodGroups::keyOf(const GroupPart& part, int movedBy) const {
  const bool isInstanced =
      model_.nodes[static_cast<std::size_t>(part.node)].extensions.contains("EXT_mesh_gpu_instancing");
  const bool isUnlike = movedBy >= 0 || part.mesh.posedNode >= 0 || isInstanced;
  return {part.mesh, isUnlike ? part.node : -1, movedBy, numbersOf(part.levelFromNode)};
}

std::size_t LodGroups::contentOf(int root) {
  const auto found = contentOfRoot_.find(root);
  if (found != contentOfRoot_.end()) return found->second;
  std::vector<PartKey> key;
  bool hasSkins = false;
  // Levels that do not lie within each other visit each node once.
  const std::size_t limit = 2 * model_.nodes.size() + 64;
  const auto rest = [this](int node) { return localTransform(model_.nodes[static_cast<std::size_t>(node)]); };
  walk(model_, root, moved_, rest, [&](int node, const glm::dmat4& levelFromNode, int movedBy) {
    if (++visits_ > limit)
      throw Error(ErrorCode::kLimit, "the levels of groups (MSFT_lod) lie within each other too often");
    if (model_.nodes[static_cast<std::size_t>(node)].mesh < 0) return;
    key.push_back(keyOf({node, shownMesh(model_, node), levelFromNode}, movedBy));
    hasSkins = hasSkins || model_.nodes[static_cast<std::size_t>(node)].skin >= 0;
  });
  const auto [place, isNew] = known_.emplace(std::move(key), contents_.size());
  if (isNew) contents_.push_back({root, hasSkins});
  contentOfRoot_.emplace(root, place->second);
  return place->second;
}

std::vector<GroupLevel> LodGroups::levelsOf(int node) {
  std::vector<int> nodes = {node};
  const std::vector<int> lower = lodIds(model_, node);
  nodes.insert(nodes.end(), lower.begin(), lower.end());
  const auto rest = [this](int of) { return localTransform(model_.nodes[static_cast<std::size_t>(of)]); };
  std::vector<GroupLevel> levels;
  for (const int level : nodes) {
    const std::size_t content = contentOf(level);
    const bool isMoved = level != node && (moved_.contains(level) || moved_.contains(node));
    const bool isOwn = isMoved || contents_[content].hasSkins;
    levels.push_back({content, level, isOwn ? node : -1, numbersOf(groupFromLevel(rest, node, level))});
  }
  return levels;
}

std::vector<GroupPart> LodGroups::parts(std::size_t content, const LocalTransform& local) const {
  std::vector<GroupPart> parts;
  walk(model_, contents_[content].root, moved_, local, [&](int node, const glm::dmat4& levelFromNode, int) {
    if (model_.nodes[static_cast<std::size_t>(node)].mesh >= 0)
      parts.push_back({node, shownMesh(model_, node), levelFromNode});
  });
  return parts;
}

glm::dmat4 groupFromLevel(const LocalTransform& local, int group, int level) {
  if (group == level) return glm::dmat4(1.0);
  const glm::dmat4 parentFromGroup = local(group);
  const glm::dmat4 parentFromLevel = local(level);
  if (parentFromGroup == parentFromLevel) return glm::dmat4(1.0);
  const glm::dmat4 placed = glm::inverse(parentFromGroup) * parentFromLevel;
  return isFinite(placed) ? placed : glm::dmat4(1.0);
}

}  // namespace jalousie::asset::detail
