// Finds what is scattered: all meshes that a scene shows, each with its LOD chain and its place.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "asset/scene_types.h"
#include "core/aabb.h"

namespace jalousie::scatter {

constexpr const char* kLights = "KHR_lights_punctual";

/// Translation, rotation and scale: x -> translation + rotation * (scale * x).
struct Pose {
  glm::vec3 translation{0.0F};
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
  glm::vec3 scale{1.0F};
};

/// A node with a mesh.
struct SourcePart {
  std::string name;             ///< of the node, else of its mesh
  std::vector<int> meshes;      ///< of the input, LOD 0 first
  std::vector<float> coverage;  ///< MSFT_screencoverage, may be empty
  bool endsInNothing = false;   ///< below the last level, nothing is shown
  std::vector<double> weights;  ///< of morph targets, may be empty
  std::vector<Pose> poses;      ///< worldFromObject in the input, one for each of the node's instances; never empty
  std::uint64_t triangles = 0;  ///< of LOD 0
  Aabb boxObject;               ///< of LOD 0, object space
  std::vector<glm::vec3> outermost;  ///< vertices of LOD 0, object space; empty without findOutermost()
};

/// What one scattered object consists of.
struct SourceAsset {
  std::vector<SourcePart> parts;  ///< in the order of the nodes, depth first; never empty
  glm::vec3 center{0.0F};         ///< of the box of all parts, world space of the input
  float diagonal = 0.0F;          ///< of that box; of a single instance: of its own box with its scale, world units
  asset::ContentCounts ignored;   ///< what of the input is not scattered: "lights", "skins" and others

  /// Whether the asset is one mesh, shown once.
  bool isSingle() const { return parts.size() == 1 && parts[0].poses.size() == 1; }
  std::uint64_t triangles() const;  ///< of LOD 0, all instances
  std::uint32_t levels() const;     ///< of the longest chain
};

/// Instances of meshes that one scattered object becomes, counted without reading them. Errors: as findSourceAsset.
std::uint64_t instancesPerObject(const tinygltf::Model& model);

/// Finds all nodes with triangles in the default scene. Of a group with levels, LOD 0 is taken.
/// Errors: kUnsupported (no mesh in the scene, a transform with shear or without an inverse, meshes without size),
/// kMalformed, kLimit.
SourceAsset findSourceAsset(const tinygltf::Model& model);

/// Finds the vertices of each part that lie farthest in 342 directions: however an object is turned, its lowest vertex
/// is about as low as the lowest of these, within 1 % of its size. @param model  that the asset was found in
void findOutermost(const tinygltf::Model& model, SourceAsset& source);

}  // namespace jalousie::scatter
