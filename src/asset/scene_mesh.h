// Conversion of glTF meshes to indexed triangles with complete attributes.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <vector>

#include "asset/accessor_budget.h"
#include "asset/mesh_pose.h"
#include "asset/scene_types.h"

namespace jalousie::asset::detail {

/// What meshes are read for.
struct MeshContext {
  const std::vector<Material>& materials;  ///< of the scene; the last one is for primitives that name none
  ElementBudget& budget;
  const MeshPose& pose;                   ///< how the mesh is bent
  const BendingTables* tables = nullptr;  ///< where an animated mesh finds its joints and weights; may be null
};

/// Reads the triangles of a mesh. @param bending  gets the bending of each primitive, if context.tables is there and
/// this is not null. Primitives without triangles (points, lines, no POSITION) are left out.
/// Errors: kMalformed, kLimit.
Mesh readMesh(const tinygltf::Model& model, int mesh, const MeshContext& context,
              std::vector<PrimitiveBending>* bending = nullptr);

/// Whether a mesh has points or lines.
bool hasLooseGeometry(const tinygltf::Mesh& mesh);
/// Whether a primitive is points or lines.
bool isLoose(const tinygltf::Primitive& primitive);
/// Vertices that a primitive of points or lines becomes. @param elements  its indices, or its vertices
std::uint64_t looseVertexCount(const tinygltf::Primitive& primitive, std::uint64_t elements);
/// Reads the points and lines of a mesh. Errors: kMalformed, kLimit.
LooseGeometry readLooseGeometry(const tinygltf::Model& model, int mesh, const MeshContext& context);

}  // namespace jalousie::asset::detail
