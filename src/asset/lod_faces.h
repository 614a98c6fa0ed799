// Groups of triangles of similar facing in the baked format: extras.jalousie.faces of a level's mesh.
//
//   "faces": {"kind": "masks", "clusters" or "meshlets", "trees": [[n0, n1, ...], 0, ...]}
//
// For each primitive trees of groups in preorder: 0 is a node whose two parts follow, another number a group of so many
// triangles, in the order of the primitive's triangles. 0 instead of a list: the primitive is left whole. (Readers drop
// empty lists.) What a test needs of a group follows from its triangles.
#pragma once

#include <tiny_gltf.h>

#include <vector>

#include "asset/face_groups.h"

namespace jalousie::asset {

/// The groups of a mesh.
struct LodFaces {
  FaceGrouping grouping = FaceGrouping::kOff;  ///< kOff: there are none
  std::vector<FaceTree> trees;                 ///< for each primitive; empty if there are none

  friend bool operator==(const LodFaces&, const LodFaces&) = default;
};

/// The value of "kind", also of the baker's option: "off", "masks", "clusters", "meshlets".
const char* nameOf(FaceGrouping grouping);

/// Adds groups to extras.jalousie. Nothing without groups. @pre setLodInfo with measures was called, and setLodCells if
/// there are cells; a tree for each primitive (checked)
void setLodFaces(tinygltf::Mesh& mesh, const LodFaces& faces);
/// Reads them back. Errors: kMalformed (wrong types, an unknown kind, not one list for each primitive, lists that are
/// no complete trees, that do not hold all triangles of their primitive, or that cross the border of a cell).
/// @pre the indices of the mesh's accessors are in range
LodFaces lodFaces(const tinygltf::Model& model, const tinygltf::Mesh& mesh);

}  // namespace jalousie::asset
