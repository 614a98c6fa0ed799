// Where animations put nodes at a time.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "asset/read_limits.h"

namespace jalousie::asset {

/// Keys of a sampler. CUBICSPLINE has three values a key: in-tangent, value, out-tangent.
struct MotionKeys {
  std::vector<float> times;   ///< seconds, ascending
  std::vector<float> values;  ///< width numbers each
  std::size_t width = 0;
};

/// Evaluates the animations of a document: LINEAR (slerp for rotations), STEP and CUBICSPLINE (glTF 2.0, appendix C).
/// For each property of a node, the first channel of any animation that moves it counts. Before the first key and after
/// the last one, a property has their values. Keys are read at their first use and kept.
class NodeMotion {
 public:
  /// Keeps references; both must outlive this.
  NodeMotion(const tinygltf::Model& model, const Limits& limits);

  /// Whether something moves a node itself, relative to its parent.
  bool moves(int node) const;
  /// The keys that move a property, "translation", "rotation", "scale" or "weights", of a node; null if nothing does.
  const tinygltf::AnimationSampler* samplerOf(int node, const std::string& property) const;
  /// Time of the last key of all channels that move a node, seconds; 0 without. Errors: as transformAt.
  float lastKey(int node);

  /// The keys of a property, "translation", "rotation", "scale" or "weights", that a sampler moves. Errors: as
  /// transformAt.
  const MotionKeys& keysOf(const tinygltf::AnimationSampler& sampler, const std::string& property);
  /// parentFromNode at a time in seconds. Errors: kMalformed for keys that do not fit together, kLimit.
  glm::dmat4 transformAt(int node, double seconds);
  /// Weights of the morph targets of a node's mesh at a time: animated, else of the node, else of the mesh, else zeros.
  /// Errors: as transformAt.
  std::vector<double> weightsAt(int node, double seconds);
  /// The same without animations.
  std::vector<double> restWeights(int node) const;

 private:
  /// The value of a property at a time; empty if nothing moves it.
  std::vector<double> valueAt(int node, const std::string& property, double seconds);

  const tinygltf::Model& model_;
  const Limits& limits_;
  std::map<std::pair<int, std::string>, const tinygltf::AnimationSampler*> samplers_;  ///< by node and property
  std::map<std::pair<const tinygltf::AnimationSampler*, std::string>, MotionKeys> keys_;
};

/// Requires that times of keys are finite and ascend. Errors: kMalformed.
void requireAscending(const std::vector<float>& times);

}  // namespace jalousie::asset
