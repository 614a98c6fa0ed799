// Collects what animations move while a scene is read.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asset/mesh_pose.h"
#include "asset/node_motion.h"
#include "asset/scene_motion.h"

namespace jalousie::asset::detail {

/// Makes a SceneMotion step by step. Errors of all calls: kMalformed for keys and skins that do not fit, kLimit.
class MotionReader {
 public:
  /// Keeps references; both must outlive this.
  MotionReader(const tinygltf::Model& model, NodeMotion& motion);

  /// Notes that an instance, or points and lines, follow a node. Does nothing if no animation moves the node.
  void addInstance(std::uint32_t instance, int node, const glm::dmat4& nodeFromInstance);
  void addLooseInstance(std::uint32_t instance, int node, const glm::dmat4& nodeFromInstance);
  /// Whether animations bend the mesh of a node: move a joint of its skin, or change the weights of its morph targets.
  bool bends(int node);
  /// Whether an animation moves a node relative to one above it.
  bool movesWithin(int node, int above) { return anchorOf(node).node != anchorOf(above).node; }
  /// What the vertices of a node's mesh refer to. @pre bends(node)
  BendingTables tablesOf(int node);
  void addMesh(MeshBending mesh) { result_.meshes.push_back(std::move(mesh)); }
  /// The most by which a length of a node's mesh grows at some of the times that it is bent.
  double largestScale(int node);
  /// The result, relative to a point of the document.
  SceneMotion take(const glm::dvec3& originWorld);

 private:
  /// A node relative to the nearest node at or above it that moves.
  struct Anchor {
    std::uint32_t node = gpu::kNoMotion;
    glm::dmat4 anchorFromNode{1.0};
  };

  const Anchor& anchorOf(int node);
  std::uint32_t trackOf(int node, const std::string& property);
  std::uint32_t addNode(int node, const Anchor& parent);
  std::uint32_t firstJoint(int skin);
  std::uint32_t firstWeight(int node);
  bool hasMovingJoints(int skin);
  std::optional<Follower> follower(std::uint32_t index, int node, const glm::dmat4& nodeFromTarget);

  const tinygltf::Model& model_;
  NodeMotion& motion_;
  SceneMotion result_;
  std::vector<int> parents_;
  std::vector<std::optional<Anchor>> anchors_;
  std::vector<std::uint32_t> depths_;          ///< moving nodes at and above each moving node
  std::vector<glm::dmat4> anchorFromParents_;  ///< of result_.nodes
  std::vector<glm::dmat4> targetsOfJoints_;    ///< of result_.joints
  std::map<std::pair<const tinygltf::AnimationSampler*, std::string>, std::uint32_t> tracks_;
  std::map<int, std::uint32_t> joints_;  ///< first joint of each skin
  std::map<int, std::uint32_t> weights_;
  std::map<int, bool> movingSkins_;
};

}  // namespace jalousie::asset::detail
