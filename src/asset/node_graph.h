// Finds the roots and the transforms of a glTF document's nodes.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <vector>

namespace jalousie::asset {

/// parentFromNode: the node's matrix, or its translation * rotation * scale. In double precision, because products
/// along a deep hierarchy are rounded to float only once. Errors: kMalformed (a rotation without direction).
glm::dmat4 localTransform(const tinygltf::Node& node);

/// Whether every number of a transform is finite as a float, which is what renderers use.
bool isFinite(const glm::dmat4& transform);

/// Parent of each node; -1 for nodes without one. @pre the document is valid
std::vector<int> parentsOf(const tinygltf::Model& model);

/// Roots of the scene to show: what the default scene lists, else scene 0, without nodes that lie below others of them;
/// in a document without scenes all nodes that are neither a child nor a level of an MSFT_lod chain. Errors: as
/// lodIds.
std::vector<int> sceneRoots(const tinygltf::Model& model);

}  // namespace jalousie::asset
