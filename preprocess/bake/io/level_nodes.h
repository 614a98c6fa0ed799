// Tells the nodes of coarser levels from all other nodes.
#pragma once

#include <tiny_gltf.h>

#include <vector>

namespace jalousie::bake {

/// For each node whether an MSFT_lod chain lists it as a coarser level, or whether it lies below a coarser level of a
/// group. Errors: kMalformed (of lodIds).
std::vector<bool> levelNodes(const tinygltf::Model& model);
/// For each node whether it is LOD 0 of a group, or lies below one. Errors: kMalformed (of lodIds).
std::vector<bool> finestGroupNodes(const tinygltf::Model& model);

}  // namespace jalousie::bake
