// Animations of a scene, as they play: plain values.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "shared/motion_structs.h"

namespace jalousie::asset {

/// The vertices of a primitive before a pose bends them, and what moves them. Vectors per vertex are in the order of
/// Primitive::positions.
struct PrimitiveBending {
  std::vector<glm::vec3> positions;           ///< without morph targets and skin
  std::vector<glm::vec3> normals;             ///< unit or longer; empty: each triangle has the normal of its plane
  bool isSkinned = false;                     ///< the influences place the vertices, even those without any
  std::vector<std::uint32_t> firstInfluence;  ///< [positions + 1] if skinned, else empty
  std::vector<gpu::Influence> influences;     ///< joints index SceneMotion::joints
  std::uint32_t targets = 0;                  ///< morph targets
  std::vector<gpu::MorphDelta> deltas;        ///< [targets][positions]
};

/// A mesh that a skin or morph targets bend.
struct MeshBending {
  std::uint32_t mesh = 0;                    ///< index into SceneFile::meshes
  std::uint32_t firstWeight = 0;             ///< of its morph targets, index into SceneMotion::weights
  std::vector<PrimitiveBending> primitives;  ///< as Mesh::primitives
};

/// How something follows a node.
struct Follower {
  std::uint32_t index = 0;  ///< what follows: into SceneFile::instances or looseInstances
  gpu::MotionTarget target{};
};

/// All animations of nodes, skins and morph targets of a scene; nothing moves before a time is chosen. For each
/// property of a node, the first channel of any animation that moves it counts.
struct SceneMotion {
  float lastKey = 0.0F;        ///< seconds; later, all rests
  std::vector<float> numbers;  ///< times and values of keys
  std::vector<gpu::MotionTrack> tracks;
  std::vector<gpu::MotionNode> nodes;  ///< those above come first
  std::vector<gpu::MotionWeight> weights;
  std::vector<gpu::MotionTarget> joints;  ///< of all skins; their destinations are their indices
  std::vector<Follower> instances;        ///< that nodes move
  std::vector<Follower> looseInstances;
  std::vector<MeshBending> meshes;

  bool empty() const { return nodes.empty() && meshes.empty(); }
};

}  // namespace jalousie::asset
