// Combines the meshes of a level of a group into one mesh.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

#include "asset/lod_group.h"
#include "asset/read_limits.h"
#include "asset/scene_mesh.h"
#include "asset/scene_pose.h"
#include "asset/scene_types.h"

namespace jalousie::asset::detail {

/// A mesh with each vertex moved. Triangles and normals keep their facing if the transform mirrors. Stored cells are
/// left out.
/// Errors: kMalformed (a position that is not finite).
Mesh placedMesh(Mesh mesh, const glm::dmat4& transform);

/// All meshes of a level, in the space of the group's node.
struct LevelMesh {
  Mesh mesh;              ///< its primitives in the order of the nodes; none if the level has no triangles
  std::size_t parts = 0;  ///< nodes with triangles
  /// The largest of the parts' stored errors, with their scale; infinite where a part states none.
  float errorObject = 0.0F;
  std::optional<float> meanErrorObject = 0.0F;  ///< the largest of the stored means; absent where a part states none
};

/// What a level is read for.
struct GroupPlace {
  int group;                  ///< the group's node
  glm::dmat4 worldFromGroup;  ///< skinned vertices are in the world
};

/// Reads levels of groups.
class GroupReader {
 public:
  /// Keeps references; all must outlive the reader.
  GroupReader(const tinygltf::Model& model, const Limits& limits, ScenePose& pose, const LodGroups& groups)
      : model_(model), limits_(limits), pose_(pose), groups_(groups) {}

  /// Instances (EXT_mesh_gpu_instancing) of a part become copies in the mesh.
  /// @param materials  as MeshContext   @param budget  is taken from for each copy
  /// Errors: as readMesh and readInstances; kUnsupported (skinned parts of a group whose transform has no inverse).
  LevelMesh read(const GroupLevel& level, const GroupPlace& place, const std::vector<Material>& materials,
                 ElementBudget& budget);

 private:
  void addPart(const GroupPart& part, const glm::dmat4& groupFromMesh, const MeshContext& context, LevelMesh& level);

  const tinygltf::Model& model_;
  const Limits& limits_;
  ScenePose& pose_;
  const LodGroups& groups_;
};

}  // namespace jalousie::asset::detail
