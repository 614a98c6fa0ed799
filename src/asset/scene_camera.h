// Cameras of a glTF scene and the animation of their nodes.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "asset/node_motion.h"
#include "asset/read_limits.h"
#include "asset/scene_types.h"

namespace jalousie::asset::detail {

/// Frames per second of evaluated poses: those of camera paths (scene::kPathRate).
inline constexpr double kSampleRate = 30.0;

/// Reads the cameras of one document. Keys that several cameras use are read once and shared.
///
/// A track has the keys of the camera's node where these say all: LINEAR or STEP keys of translation and rotation, and
/// no node above it that moves, scales or mirrors. Else the pose in the world is evaluated at every frame of
/// kSampleRate, without scale and mirroring.
class CameraReader {
 public:
  /// Keeps references; all must outlive the reader.
  CameraReader(const tinygltf::Model& model, const Limits& limits, NodeMotion& motion);

  /// The camera of a node. Errors: kMalformed (a number out of its range).
  Camera read(int node, const glm::dmat4& worldFromParent, const glm::dmat4& worldFromNode);

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
  bool hasPlainTrack(int node, const glm::dmat4& worldFromParent) const;
  /// Rigid pose of a camera at a time. Errors: kMalformed (a transform without an inverse).
  glm::dmat4 poseAt(int node, double seconds);
  /// @param start  gets the place of the first pose; the track's places are relative to it
  CameraTrack sampledTrack(int node, glm::dvec3& start);
  template <class Value, class Read>
  const Keys<Value>& keysOf(KeyTable<Value>& table, const tinygltf::AnimationSampler& sampler, const Read& read);

  const tinygltf::Model& model_;
  const Limits& limits_;
  NodeMotion& motion_;
  std::vector<int> parents_;         ///< of each node; -1: none
  std::uint64_t sampledFrames_ = 0;  ///< of all cameras
  KeyTable<glm::vec3> positions_;
  KeyTable<glm::quat> rotations_;
};

}  // namespace jalousie::asset::detail
