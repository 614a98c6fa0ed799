// Collects the nodes that the chains of a document list.
#include "bake/io/level_nodes.h"

#include "asset/lod_chain.h"

namespace jalousie::bake {

namespace {

/// Marks a node and all nodes below it. @pre the hierarchy has no cycle
void markBelow(const tinygltf::Model& model, int root, std::vector<bool>& marks) {
  std::vector<int> stack = {root};
  while (!stack.empty()) {
    const auto node = static_cast<std::size_t>(stack.back());
    stack.pop_back();
    if (marks[node]) continue;  // with all nodes below it
    marks[node] = true;
    stack.insert(stack.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
  }
}

}  // namespace

std::vector<bool> levelNodes(const tinygltf::Model& model) {
  std::vector<bool> isLevel(model.nodes.size(), false);
  std::vector<bool> isInGroup(model.nodes.size(), false);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const bool isGroup = asset::isLodGroup(model, static_cast<int>(n));
    for (const int level : asset::lodIds(model, static_cast<int>(n))) {
      isLevel[static_cast<std::size_t>(level)] = true;
      if (isGroup) markBelow(model, level, isInGroup);
    }
  }
  for (std::size_t n = 0; n < isLevel.size(); ++n)
    isLevel[n] = isLevel[n] || isInGroup[n];
  return isLevel;
}

std::vector<bool> finestGroupNodes(const tinygltf::Model& model) {
  std::vector<bool> isFinest(model.nodes.size(), false);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (asset::isLodGroup(model, static_cast<int>(n))) markBelow(model, static_cast<int>(n), isFinest);
  return isFinest;
}

}  // namespace jalousie::bake
