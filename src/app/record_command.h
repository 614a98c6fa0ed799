// `jalousie record`: a camera path as a glTF camera animation, from key poses or around the scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "asset/scene_file.h"
#include "core/aabb.h"
#include "scene/camera.h"

namespace CLI {
class App;
}

namespace jalousie::app {

/// Where the camera is at a frame, and what it looks at; world units.
struct KeyPose {
  std::uint32_t frame = 0;
  glm::vec3 eye{0.0F};
  glm::vec3 look{0.0F};
};

struct RecordOptions {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::vector<std::string> keys;  ///< FRAME:EYE:LOOK
  float orbitDegrees = 360.0F;
  float elevationDegrees = 15.0F;
  float distance = 1.0F;  ///< of the orbit, as a share of that at which the whole scene is in view
  std::uint32_t frames = 300;
  float fovDegrees = 45.0F;
  bool quiet = false;
  bool orbitGiven = false;
};

/// Declares the options on a subcommand; values land in options, which must outlive the parse.
void addRecordOptions(CLI::App& command, RecordOptions& options);

/// Adds the pose of a camera at a frame of a path; rotations keep their sign from pose to pose.
void addPose(asset::CameraTrack& track, std::uint32_t frame, const scene::Camera& camera);

/// Writes a GLB that holds nothing but an animated camera; @return its number of frames.
/// @param fovY  radians   Errors: as saveGlb.
std::uint32_t savePath(const asset::CameraTrack& track, float fovY, const Aabb& sceneWorld,
                       const std::filesystem::path& file);

/// "FRAME:X,Y,Z:X,Y,Z". Errors: kUsage.
KeyPose parseKey(const std::string& text);

/// Through all keys without a corner: cubic Hermite splines of eye and target with the slopes of their neighbours
/// (Catmull and Rom 1974, with unequal spacing), one pose a frame. Rotations have no jumps of sign.
/// @pre keys not empty, frames ascend (checked). Errors: kUsage where an eye meets its target.
asset::CameraTrack splineTrack(const std::vector<KeyPose>& keys, const Aabb& sceneWorld);

/// Errors: kUsage; as readSceneFile and saveGlb.
void runRecord(const RecordOptions& options);

}  // namespace jalousie::app
