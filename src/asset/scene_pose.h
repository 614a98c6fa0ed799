// The pose of a whole document at a time.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "asset/mesh_pose.h"
#include "asset/node_motion.h"

namespace jalousie::asset::detail {

/// The inverse bind matrices of a skin; identities where it has none.
std::vector<glm::dmat4> inverseBindMatrices(const tinygltf::Model& model, const tinygltf::Skin& skin);

/// Where nodes are, and how their meshes are bent.
class ScenePose {
 public:
  /// Keeps references; both must outlive this. @param motion  of the document
  /// @param seconds  time of all animations; absent: the pose without animations
  ScenePose(const tinygltf::Model& model, NodeMotion& motion, std::optional<double> seconds);

  /// parentFromNode. Errors: as NodeMotion::transformAt.
  glm::dmat4 localTransform(int node);
  /// How a node's mesh is bent. Errors: kMalformed, kLimit.
  MeshPose meshPose(int node);

 private:
  const std::vector<glm::dmat4>& worldFromNodes();

  const tinygltf::Model& model_;
  std::optional<double> seconds_;
  NodeMotion& motion_;
  std::vector<glm::dmat4> worldFromNodes_;  ///< made for the first skin
};

}  // namespace jalousie::asset::detail
