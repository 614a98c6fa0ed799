// Reads a glTF mesh into one index buffer and writes levels back as glTF meshes.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>

#include "asset/gltf_file.h"
#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

/// The reason why a mesh is passed through unchanged: a mode other than triangles, morph targets, no positions,
/// joints, or more than 16 attributes. Empty if the mesh can be baked.
std::string unbakeableReason(const tinygltf::Mesh& mesh);

/// Reads all primitives of a mesh. Bit-identical vertices are shared; positions may be NaN or infinite (see cleanMesh).
/// Errors: kMalformed, kLimit.
CombinedMesh readCombinedMesh(const tinygltf::Model& model, const tinygltf::Mesh& mesh, const asset::Limits& limits);

/// A mesh that was appended to a document.
struct WrittenMesh {
  int mesh = -1;               ///< index in the document
  std::uint32_t vertices = 0;  ///< of all its primitives
};

/// Appends a mesh with the primitives of `source` and the triangles of `combined`, in vertex-cache and fetch order.
/// Primitives without triangles are left out.
WrittenMesh appendLevelMesh(tinygltf::Model& model, const tinygltf::Mesh& source, const CombinedMesh& combined);

}  // namespace jalousie::bake
