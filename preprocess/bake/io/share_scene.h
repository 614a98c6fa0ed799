// Divides one budget of triangles among the meshes of a document.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bake/io/prepared_mesh.h"

namespace jalousie::bake {

/// What a mesh of a scene of one budget is told, by its index in the document.
struct SceneShare {
  std::vector<std::vector<std::uint32_t>> targets;  ///< see ChainOptions::targets; a last one of 0: see leftOut
  std::vector<double> reference;                    ///< see ChainOptions::reference
  std::vector<std::vector<glm::vec3>> touching;     ///< places of border vertices that other meshes share
};

/// Whether the meshes of a document share a budget. @param used  meshes that nodes use
bool sharesBudget(const BakeOptions& options, std::span<const std::size_t> used);

/// @pre sharesBudget. Errors: those of prepareMesh, each naming the mesh
SceneShare shareScene(const tinygltf::Model& model, std::span<const std::size_t> used, const MeshUse& use,
                      const BakeOptions& options);

/// The options of one mesh.
BakeOptions optionsInScene(const BakeOptions& options, const SceneShare& share, std::size_t mesh);

}  // namespace jalousie::bake
