// Tells the nodes of coarser levels from all other nodes.
#pragma once

#include <tiny_gltf.h>

#include <vector>

namespace jalousie::bake {

/// For each node whether an MSFT_lod chain lists it as a coarser level. Errors: kMalformed (of lodNodes).
std::vector<bool> levelNodes(const tinygltf::Model& model);

}  // namespace jalousie::bake
