// EXT_mesh_gpu_instancing: reads and writes the transforms of a node's instances.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "asset/read_limits.h"

namespace jalousie::asset {

/// Transforms nodeFromInstance = T * R * S. All three vectors have the same length.
struct Instances {
  std::vector<glm::vec3> translations;
  std::vector<glm::quat> rotations;
  std::vector<glm::vec3> scales;
};

/// Appends the accessors of EXT_mesh_gpu_instancing and returns the extension's value, so that a LOD chain's nodes can
/// share it: node.extensions["EXT_mesh_gpu_instancing"] = value. Declares the extension in model.extensionsUsed.
tinygltf::Value appendInstances(tinygltf::Model& model, const Instances& instances);
/// Number of a node's instances, 0 if it has no such extension; reads none. Errors: kMalformed, kLimit.
std::uint64_t countInstances(const tinygltf::Model& model, int node, const Limits& limits = {});
/// Checks counts, types, ranges and rotations as readInstances does. Allocates only what follows the file's size:
/// accessors without data are not expanded. @return  countInstances   Errors: kMalformed, kLimit.
std::uint64_t checkInstances(const tinygltf::Model& model, int node, const Limits& limits = {});

/// A node's instances as a file holds them.
struct InstanceTransforms {
  std::uint64_t count = 0;  ///< 0 if the node has no such extension
  Instances values;         ///< each vector has `count` elements, or one that all instances share

  /// Transform of one instance. @param i  below count
  [[nodiscard]] glm::dmat4 nodeFromInstance(std::uint64_t i) const;
  /// Whether all instances share one transform, which is at index 0.
  [[nodiscard]] bool areEqual() const;
};

/// Reads a node's instances. Missing attributes are identity; these and accessors without data are not expanded.
/// Errors: kMalformed (counts differ), kLimit.
InstanceTransforms readInstances(const tinygltf::Model& model, int node, const Limits& limits = {});

}  // namespace jalousie::asset
