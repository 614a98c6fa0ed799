// Reads a glTF mesh into one index buffer and writes levels back as glTF meshes.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>

#include "asset/gltf_file.h"
#include "asset/lod_chain.h"
#include "asset/lod_faces.h"
#include "bake/io/level_cells.h"
#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

/// Whether it is a list, a strip or a fan of triangles.
bool hasTriangles(const tinygltf::Primitive& primitive);

/// The reason why a mesh is passed through unchanged: no triangles, morph targets, no positions, joints, more than 16
/// attributes, or an extension that may refer to its vertices. Empty if the mesh can be baked.
std::string unbakeableReason(const tinygltf::Model& model, const tinygltf::Mesh& mesh);

/// Reads the primitives of a mesh that have triangles: lists, strips and fans. Those with feature IDs or other
/// attributes that must not be averaged (keptAttributes) become one primitive for each value. Bit-identical vertices
/// are shared; positions may be NaN or infinite (see cleanMesh).
/// Errors: kMalformed, kLimit.
CombinedMesh readCombinedMesh(const tinygltf::Model& model, const tinygltf::Mesh& mesh, const asset::Limits& limits);

/// A mesh that was appended to a document.
struct WrittenMesh {
  int mesh = -1;               ///< index in the document
  std::uint32_t vertices = 0;  ///< of all its primitives
  asset::CellTriangles cells;  ///< a list for each written primitive
  asset::LodFaces faces;       ///< a tree for each written primitive; empty for those that are left whole
};

/// Appends a mesh with the primitives of `source` and the triangles of `combined`: points and lines as they are,
/// triangles cell by cell, within a cell group by group, within a group in the order of the vertex cache, vertices in
/// the order of their first use. Primitives without triangles are left out.
/// @param order  of the triangles of `combined`   @param faces  groups of single-sided opaque triangles
WrittenMesh appendLevelMesh(tinygltf::Model& model, const tinygltf::Mesh& source, const CombinedMesh& combined,
                            const CellOrder& order, asset::FaceGrouping faces = asset::FaceGrouping::kOff);

}  // namespace jalousie::bake
