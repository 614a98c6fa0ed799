// Reads a mesh of a document up to what is simplified.
#pragma once

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bake/io/bake_options.h"
#include "bake/io/mesh_report.h"
#include "bake/mesh/combined_mesh.h"
#include "bake/mesh/wedge_mesh.h"
#include "core/error.h"

namespace jalousie::bake {

/// Who shows which mesh before the bake.
struct MeshUse {
  std::vector<std::vector<int>> users;  ///< per mesh the nodes that use it
  std::vector<bool> isLevel;            ///< per node: it is a lower level of a chain, or part of one
  std::vector<bool> isInGroup;          ///< per node: it is part of LOD 0 of a group
};
MeshUse meshUse(const tinygltf::Model& model);

/// The name of a mesh in reports.
std::string nameOf(const tinygltf::Model& model, std::size_t index);

/// Why a mesh is written as it is; empty if it is baked.
std::string reasonToPass(const tinygltf::Model& model, std::size_t index, const MeshUse& use);

struct PreparedMesh {
  MeshReport report;
  CombinedMesh mesh;                   ///< what is simplified
  std::optional<CombinedMesh> finest;  ///< LOD 0 if it has more attributes than that
  std::optional<WedgeMesh> wedges;     ///< of mesh; absent if the mesh is passed through: the report says why
};

/// Reads, cleans, welds, subdivides and examines a mesh. Changes nothing, so meshes can be prepared side by side.
/// Errors: kMalformed, kUnsupported, kLimit.
PreparedMesh prepareMesh(const tinygltf::Model& model, std::size_t index, const MeshUse& use,
                         const BakeOptions& options);

/// Calls a function for a mesh; its errors name the mesh.
template <class Work>
auto named(const tinygltf::Model& model, std::size_t index, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    const std::string name = model.meshes[index].name.empty() ? fmt::format("{}", index) : model.meshes[index].name;
    throw Error(error.code(), fmt::format("mesh '{}': {}", name, error.what()));
  }
}

}  // namespace jalousie::bake
