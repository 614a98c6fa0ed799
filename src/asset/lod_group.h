// Levels of detail of groups: what the levels of a node show if not all of them have a mesh of their own.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "asset/mesh_pose.h"

namespace jalousie::asset::detail {

/// A mesh within a level of a group.
struct GroupPart {
  int node;  ///< that shows it
  ShownMesh mesh;
  glm::dmat4 levelFromNode;  ///< relative to the level's node
};

/// parentFromNode of a node, at rest or in a pose.
using LocalTransform = std::function<glm::dmat4(int node)>;
using MatrixNumbers = std::array<double, 16>;

/// A level of a group. Equal values stand for equal geometry.
struct GroupLevel {
  std::size_t content = 0;  ///< for LodGroups::parts
  int node = 0;             ///< the level's node; not compared: others may show the same
  int group = -1;           ///< the only node that has this level; -1 if groups may share it
  MatrixNumbers place{};    ///< groupFromLevel at rest

  friend bool operator<(const GroupLevel& a, const GroupLevel& b) {
    return std::tie(a.content, a.group, a.place) < std::tie(b.content, b.group, b.place);
  }
};

/// Finds what levels of groups are made of. Levels with the same meshes at the same places have the same content.
class LodGroups {
 public:
  /// Keeps a reference. @pre the document is valid
  explicit LodGroups(const tinygltf::Model& model);

  /// All levels of a group, LOD 0 first. Reads no geometry. @pre isLodGroup(model, node)
  /// Errors: kLimit (levels that lie within each other too often).
  std::vector<GroupLevel> levelsOf(int node);
  /// The meshes of a content. Parts that have levels themselves are shown at LOD 0.
  /// @param local  of the nodes below the level's node
  std::vector<GroupPart> parts(std::size_t content, const LocalTransform& local) const;

 private:
  struct PartKey {
    ShownMesh mesh;
    int node;     ///< where an animation, a skin, morph targets or instances make the part unlike all others; else -1
    int movedBy;  ///< nearest node of it and those above that an animation moves, -1 without
    MatrixNumbers place;

    friend bool operator<(const PartKey& a, const PartKey& b) {
      return std::tie(a.mesh, a.node, a.movedBy, a.place) < std::tie(b.mesh, b.node, b.movedBy, b.place);
    }
  };
  struct Content {
    int root;  ///< a node that shows it
    bool hasSkins;
  };

  std::size_t contentOf(int root);
  PartKey keyOf(const GroupPart& part, int movedBy) const;

  const tinygltf::Model& model_;
  std::set<int> moved_;  ///< nodes that animations move
  std::map<int, std::size_t> contentOfRoot_;
  std::map<std::vector<PartKey>, std::size_t> known_;
  std::vector<Content> contents_;
  std::size_t visits_ = 0;  ///< nodes of all levels that were looked at
};

/// Where a level stands: its node takes the place of the group's node.
/// @return  groupFromLevel; the identity where both have one transform, and where the group's has no inverse
glm::dmat4 groupFromLevel(const LocalTransform& local, int group, int level);

}  // namespace jalousie::asset::detail
