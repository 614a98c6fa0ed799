// Cameras of a glTF scene and the animation of their nodes.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "asset/read_limits.h"
#include "asset/scene_types.h"

namespace jalousie::asset::detail {

/// Reads the cameras of one document. Keys that several cameras use are read once and shared.
class CameraReader {
 public:
  /// Keeps references; both must outlive the reader.
  CameraReader(const tinygltf::Model& model, const Limits& limits);

  /// The camera of a node; nullopt for an orthographic one. Errors: kMalformed (a number out of its range).
  std::optional<Camera> read(int node, const glm::dmat4& worldFromParent, const glm::dmat4& worldFromNode);

 private:
  template <class Value>
  struct Keys {
    SharedVector<float> times;
    SharedVector<Value> values;
  };
  /// Keys by the accessors of times and values and the interpolation.
  template <class Value>
  using KeyTable = std::map<std::tuple<int, int, std::string>, Keys<Value>>;

  CameraTrack trackOf(int node);
  template <class Value, class Read>
  const Keys<Value>& keysOf(KeyTable<Value>& table, const tinygltf::AnimationSampler& sampler, const Read& read);

  const tinygltf::Model& model_;
  const Limits& limits_;
  /// Channels of all animations by the node that they move, in the document's order.
  std::map<int, std::vector<std::pair<const tinygltf::Animation*, const tinygltf::AnimationChannel*>>> channels_;
  KeyTable<glm::vec3> positions_;
  KeyTable<glm::quat> rotations_;
};

}  // namespace jalousie::asset::detail
