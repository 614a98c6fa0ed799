// The edges of a wedge mesh and their kinds.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

enum class EdgeKind : std::uint8_t {
  kSmooth,       ///< two triangles that share both wedges
  kBorder,       ///< one triangle
  kNonManifold,  ///< three or more triangles, or two that run along it in the same direction
  kMaterial,     ///< between two primitives
  kSeam,         ///< texture coordinates, colours or tangents differ
  kHard          ///< only normals differ
};

/// One edge between two vertices.
struct MeshEdge {
  std::uint32_t a = 0, b = 0;  ///< vertices, a < b
  std::uint32_t firstUse = 0;  ///< into EdgeTable::uses
  std::uint32_t useCount = 0;
  EdgeKind kind = EdgeKind::kSmooth;
};

/// All edges in ascending order of (a, b). A use is a corner c whose triangle has the edge from c to its next corner.
struct EdgeTable {
  std::vector<MeshEdge> edges;
  std::vector<std::uint32_t> uses;
};

EdgeTable findEdges(const WedgeMesh& mesh);

/// Positions of the vertices of open edges. @param edges  of the mesh
std::vector<glm::vec3> borderPositions(const WedgeMesh& mesh, const EdgeTable& edges);

/// The corner after c in its triangle.
inline std::uint32_t nextCorner(std::uint32_t c) {
  return c % 3 == 2 ? c - 2 : c + 1;
}

}  // namespace jalousie::bake
