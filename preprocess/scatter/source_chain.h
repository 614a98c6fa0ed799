// Finds the object to scatter: the first mesh of a scene with its LOD chain.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "core/aabb.h"

namespace jalousie::scatter {

/// Translation, rotation and scale: x -> translation + rotation * (scale * x).
struct Pose {
  glm::vec3 translation{0.0F};
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
  glm::vec3 scale{1.0F};
};

struct SourceChain {
  std::vector<int> meshes;               ///< of the input, LOD 0 first
  std::vector<float> coverage;           ///< MSFT_screencoverage, may be empty
  std::vector<std::uint64_t> triangles;  ///< per level
  Pose worldFromObject;                  ///< of the LOD 0 node in the input
  Aabb boxObject;                        ///< of LOD 0, object space

  /// Length of the box's diagonal with the input's scale, world units.
  float diagonal() const { return glm::length(boxObject.extent() * glm::abs(worldFromObject.scale)); }
};

/// Finds the first node with a mesh, depth first, in the default scene.
/// Errors: kUnsupported (no mesh in the scene, a transform with shear, a mesh without size), kMalformed, kLimit.
SourceChain findSourceChain(const tinygltf::Model& model);

}  // namespace jalousie::scatter
