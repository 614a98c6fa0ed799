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
  const MeshPose& pose;  ///< how the mesh is bent
};

/// Reads the triangles of a mesh. Primitives without triangles (points, lines, no POSITION) are left out.
/// Errors: kMalformed, kLimit.
Mesh readMesh(const tinygltf::Model& model, int mesh, const MeshContext& context);

}  // namespace jalousie::asset::detail
