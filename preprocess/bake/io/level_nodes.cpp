// Collects the nodes that the chains of a document list.
#include "bake/io/level_nodes.h"

#include "asset/lod_chain.h"

namespace jalousie::bake {

std::vector<bool> levelNodes(const tinygltf::Model& model) {
  std::vector<bool> isLevel(model.nodes.size(), false);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    for (const int level : asset::lodNodes(model, static_cast<int>(n)))
      isLevel[static_cast<std::size_t>(level)] = true;
  return isLevel;
}

}  // namespace jalousie::bake
