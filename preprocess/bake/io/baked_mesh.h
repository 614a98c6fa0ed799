// One mesh from reading to its levels in the document.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "bake/io/prepared_mesh.h"
#include "bake/simplify/chain.h"
#include "core/cell_tree.h"

namespace jalousie::bake {

/// A mesh that was simplified and is not yet written.
struct BakedMesh {
  PreparedMesh prepared;
  LevelChain chain;  ///< without levels if the mesh is passed through
  std::vector<float> coverage;
  std::optional<CellTree> tree;
  asset::FaceGrouping faces = asset::FaceGrouping::kOff;
};

/// Reads and simplifies a mesh. Changes nothing, so meshes can be baked side by side. Errors: as prepareMesh.
BakedMesh bakeMesh(const tinygltf::Model& model, std::size_t index, const MeshUse& use, const BakeOptions& options,
                   const LevelProgress& progress);

/// Writes the levels as meshes, LOD 0 in the place of the original. @return  their indices
std::vector<int> writeLevels(tinygltf::Model& model, std::size_t index, BakedMesh& baked);

}  // namespace jalousie::bake
