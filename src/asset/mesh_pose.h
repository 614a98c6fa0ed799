// Meshes that skins bend and morph targets move.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "asset/accessor_budget.h"
#include "asset/scene_motion.h"

namespace jalousie::asset::detail {

/// How a mesh is bent at a time. Default: not at all.
struct MeshPose {
  std::vector<glm::dmat4> worldFromMesh;  ///< by joint of the skin, inverse bind matrices applied; empty: no skin
  std::vector<double> weights;            ///< of the morph targets

  bool isRest() const;
  /// The most by which a length of the mesh grows.
  double largestScale() const;
};

/// Attributes of a primitive while it is read.
struct PosedVertices {
  std::vector<glm::vec3>& positions;
  std::vector<glm::vec3>& normals;  ///< empty if the primitive has none
};

/// A mesh as a node shows it: alike for all nodes that do not bend it.
struct ShownMesh {
  int mesh;
  int posedNode;  ///< the node whose pose it has, by a skin or morph targets; -1: none

  friend bool operator<(const ShownMesh& a, const ShownMesh& b) {
    return std::pair(a.mesh, a.posedNode) < std::pair(b.mesh, b.posedNode);
  }
};
/// @pre the node has a mesh
ShownMesh shownMesh(const tinygltf::Model& model, int node);

/// Where the joints and weights of a mesh lie in a SceneMotion.
struct BendingTables {
  std::uint32_t firstJoint = 0;
  std::uint32_t joints = 0;  ///< of the skin; 0: none
  std::uint32_t firstWeight = 0;
};

/// What moves the vertices of a primitive whose attributes are not bent yet. Errors: as applyPose.
PrimitiveBending readBending(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                             const BendingTables& tables, ElementBudget& budget, const PosedVertices& vertices);
/// The bending of a primitive whose vertices are not shared any more, and have the normals of their triangles.
/// @param indices  of the triangles' corners   Errors: kLimit.
PrimitiveBending flatBending(const PrimitiveBending& shared, const std::vector<std::uint32_t>& indices,
                             ElementBudget& budget);

/// Moves the vertices of a primitive: morph targets first, then the skin (glTF 2.0, 3.7.2.2 and 3.7.3.3). Weights of
/// joints are scaled to a sum of 1.
/// Errors: kMalformed for joints and attributes that do not fit, kLimit.
void applyPose(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const MeshPose& pose,
               ElementBudget& budget, const PosedVertices& vertices);

}  // namespace jalousie::asset::detail
