// `jalousie record`: writes a camera path, through key poses or around the scene, as a glTF camera animation.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "asset/scene_file.h"
#include "core/aabb.h"
#include "core/memory_limit.h"
#include "core/output_files.h"
#include "scene/camera.h"

namespace CLI {
class App;
}

namespace jalousie::app {

/// The camera's position at a frame and the point that it looks at, in the world of the file.
struct KeyPose {
  std::uint32_t frame = 0;
  glm::dvec3 eye{0.0};
  glm::dvec3 look{0.0};
};

struct RecordOptions {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::vector<std::string> keys;  ///< FRAME:EYE:LOOK
  float orbitDegrees = 360.0F;
  float elevationDegrees = 15.0F;
  float distance = 1.0F;  ///< of the orbit; 1: the whole scene is just in view
  std::uint32_t frames = 300;
  float fovDegrees = 45.0F;
  bool quiet = false;
  MemoryLimit memory{kDefaultMaxMemory, "--max-memory"};
  Replace replace = Replace::kSameKind;
  bool orbitGiven = false;  ///< some option of the orbit was given
};

/// Declares the options on a subcommand; values land in options, which must outlive the parse.
void addRecordOptions(CLI::App& command, RecordOptions& options);

/// Appends a camera's pose at a frame. Of the two quaternions of its rotation, takes the one nearer to the last pose's.
void addPose(asset::CameraTrack& track, std::uint32_t frame, const scene::Camera& camera);

/// Writes a GLB that holds an animated camera and nothing else.
/// @param fovY  radians   @param originWorld  that track and box are relative to   @return  frames of the path
/// Errors: as saveGlb.
std::uint32_t savePath(const asset::CameraTrack& track, float fovY, const Aabb& sceneWorld,
                       const glm::dvec3& originWorld, const std::filesystem::path& file);

/// "FRAME:X,Y,Z:X,Y,Z". Errors: kUsage.
KeyPose parseKey(const std::string& text);

/// A smooth path through all keys, one pose per frame: cubic Hermite splines of eye and target, whose slope at a key is
/// that of the line through its neighbours (Catmull and Rom 1974, with unequal spacing).
/// @pre keys not empty, frames ascend (checked). Errors: kUsage where eye and target meet.
asset::CameraTrack splineTrack(const std::vector<KeyPose>& keys, const Aabb& sceneWorld);

/// Errors: kUsage; as readSceneFile and saveGlb.
void runRecord(const RecordOptions& options);

}  // namespace jalousie::app
