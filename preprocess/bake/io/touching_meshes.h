// Finds the places where the open borders of different meshes meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

/// The open borders of a mesh and the nodes that show it.
struct MeshBorder {
  std::vector<glm::dmat4> transforms;  ///< of the nodes, into the scene
  std::vector<glm::vec3> places;       ///< of vertices of open edges, object space
};

/// For each mesh the places that another node shares, in ascending order: positions in the scene that differ by at most
/// a millionth of the diagonal of all of them. Nodes of one mesh count as others, unless their transforms are equal.
/// Meshes of millions of places, times nodes, are looked at in their first nodes only.
std::vector<std::vector<glm::vec3>> touchingPlaces(std::span<const MeshBorder> meshes);

/// For each vertex of a mesh 1 if it lies at one of the places. @param places  of touchingPlaces; empty: the result is
/// empty
std::vector<std::uint8_t> verticesAt(const WedgeMesh& mesh, std::span<const glm::vec3> places);

}  // namespace jalousie::bake
