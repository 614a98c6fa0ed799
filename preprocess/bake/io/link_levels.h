// Makes nodes of the levels of a mesh and links them to the nodes that show it.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace jalousie::bake {

/// What moves each node.
struct ChannelIndex {
  std::multimap<int, std::pair<std::size_t, std::size_t>> byNode;  ///< pairs of animation and channel
  std::set<int> pointed;                                           ///< nodes that KHR_animation_pointer names
  std::set<int> joints;                                            ///< of skins
};
ChannelIndex indexChannels(const tinygltf::Model& model);

/// Appends a node for each level below LOD 0, for each of the nodes that show it, and links them with MSFT_lod. The
/// mesh of a node that holds more, that is a joint, or that a pointer moves, moves into a new child first.
/// @param channels  of the document before the bake   @param levelMeshes  LOD 0 first   @param coverage  one for each;
/// the last one is not 0 if below it nothing is shown: the chain then ends with a node that holds nothing
void linkNodes(tinygltf::Model& model, const ChannelIndex& channels, const std::vector<int>& nodes,
               const std::vector<int>& levelMeshes, const std::vector<float>& coverage);

}  // namespace jalousie::bake
