// Builds spline and orbit paths and writes them as GLB.
#include "app/record_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "app/command_memory.h"
#include "app/number_option.h"
#include "app/option_values.h"
#include "asset/camera_write.h"
#include "asset/gltf_file.h"
#include "cli/force_option.h"
#include "cli/memory_option.h"
#include "cli/program.h"
#include "core/check.h"
#include "core/error.h"
#include "core/memory_estimate.h"
#include "core/output_files.h"
#include "core/standard_streams.h"
#include "scene/camera.h"
#include "scene/scene_data.h"

namespace jalousie::app {
namespace {

constexpr std::uint32_t kMostFrames = 1'000'000;

/// Slope of a value at key k, per frame: that of the line through the neighbouring keys; one-sided at both ends.
template <class Get>
glm::vec3 slopeAt(const std::vector<KeyPose>& keys, std::size_t k, Get get) {
  const KeyPose& before = keys[k > 0 ? k - 1 : k];
  const KeyPose& after = keys[std::min(k + 1, keys.size() - 1)];
  if (before.frame == after.frame) return glm::vec3(0.0F);
  return (get(after) - get(before)) / static_cast<float>(after.frame - before.frame);
}

/// Value at a frame between the keys k and k + 1.
template <class Get>
glm::vec3 hermite(const std::vector<KeyPose>& keys, std::size_t k, float frame, Get get) {
  if (k + 1 == keys.size()) return get(keys[k]);
  const auto length = static_cast<float>(keys[k + 1].frame - keys[k].frame);
  const float t = (frame - static_cast<float>(keys[k].frame)) / length;
  const float t2 = t * t;
  const float t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * get(keys[k]) + (t3 - 2 * t2 + t) * length * slopeAt(keys, k, get) +
         (3 * t2 - 2 * t3) * get(keys[k + 1]) + (t3 - t2) * length * slopeAt(keys, k + 1, get);
}

asset::CameraTrack orbitTrack(const RecordOptions& options, const Aabb& sceneWorld) {
  if (sceneWorld.empty())
    throw Error(ErrorCode::kUnsupported, "the scene is empty, there is nothing to turn around; give --key",
                options.scene);
  const glm::vec3 center = sceneWorld.center();
  const float radius = std::max(0.5F * sceneWorld.diagonal(), 1e-6F);
  const float distance = options.distance * radius / std::sin(0.5F * glm::radians(options.fovDegrees));
  const float height = glm::radians(options.elevationDegrees);
  asset::CameraTrack track;
  for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
    // A whole turn ends one step before its start, so that the path can be played in a loop without a pause.
    const float angle =
        glm::radians(options.orbitDegrees) * static_cast<float>(frame) / static_cast<float>(options.frames);
    const glm::vec3 direction(std::sin(angle) * std::cos(height), std::sin(height), std::cos(angle) * std::cos(height));
    addPose(track, frame, scene::lookAt(center + distance * direction, center, sceneWorld));
  }
  return track;
}

/// The scene that the path belongs to. @param frames  of the path that will be written
scene::SceneData sceneFor(const RecordOptions& options, std::uint32_t frames) {
  // Two times, a position and a rotation, as vectors that grow, as glTF accessors and as an encoded file.
  constexpr std::uint64_t kFrameBytes = 2 * sizeof(float) + sizeof(glm::vec3) + sizeof(glm::quat);
  const auto needs = [&](const asset::SceneSize& size) {
    MemoryEstimate estimate = flatNeeds(size);
    estimate.add(frames, 5 * kFrameBytes, std::to_string(frames) + " frames");
    return estimate;
  };
  return scene::buildScene(readWithin(options.scene, options.memory, needs));
}

}  // namespace

void addPose(asset::CameraTrack& track, std::uint32_t frame, const scene::Camera& camera) {
  glm::quat rotation = glm::normalize(glm::quat_cast(glm::mat3(camera.worldFromCamera)));
  if (!track.rotations.empty() && glm::dot(rotation, track.rotations.back()) < 0.0F) rotation = -rotation;
  const float seconds = static_cast<float>(frame) / scene::kPathRate;
  track.translationTimes.edit().push_back(seconds);
  track.rotationTimes.edit().push_back(seconds);
  track.translations.edit().push_back(camera.positionWorld());
  track.rotations.edit().push_back(rotation);
}

KeyPose parseKey(const std::string& text) {
  const std::size_t first = text.find(':');
  const std::size_t second = first == std::string::npos ? first : text.find(':', first + 1);
  KeyPose key;
  if (second != std::string::npos && CLI::detail::lexical_cast(text.substr(0, first), key.frame) &&
      key.frame < kMostFrames) {
    const std::optional<glm::dvec3> eye = parsePoint(std::string_view(text).substr(first + 1, second - first - 1));
    const std::optional<glm::dvec3> look = parsePoint(std::string_view(text).substr(second + 1));
    if (eye && look) return {key.frame, *eye, *look};
  }
  throw Error(ErrorCode::kUsage,
              fmt::format("--key {}: expected FRAME:X,Y,Z:X,Y,Z, the eye and then the point that it looks at", text));
}

asset::CameraTrack splineTrack(const std::vector<KeyPose>& keys, const Aabb& sceneWorld) {
  JAL_CHECK(!keys.empty());
  for (std::size_t i = 1; i < keys.size(); ++i)
    JAL_CHECK(keys[i - 1].frame < keys[i].frame);
  asset::CameraTrack track;
  std::size_t k = 0;
  for (std::uint32_t frame = keys.front().frame; frame <= keys.back().frame; ++frame) {
    while (k + 1 < keys.size() && frame >= keys[k + 1].frame)
      ++k;
    const auto at = static_cast<float>(frame);
    const glm::vec3 eye = hermite(keys, k, at, [](const KeyPose& key) { return glm::vec3(key.eye); });
    const glm::vec3 look = hermite(keys, k, at, [](const KeyPose& key) { return glm::vec3(key.look); });
    addPose(track, frame, scene::lookAt(eye, look, sceneWorld));
  }
  return track;
}

std::uint32_t savePath(const asset::CameraTrack& track, float fovY, const Aabb& sceneWorld,
                       const glm::dvec3& originWorld, const std::filesystem::path& file) {
  asset::Camera camera;
  camera.fovY = fovY;
  camera.zNear = scene::lookAt({0, 0, 1}, {0, 0, 0}, sceneWorld).zNear;
  camera.track = track;
  camera.worldFromParent[3] = glm::dvec4(originWorld, 1.0);
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "jalousie " JALOUSIE_VERSION;
  model.scenes.resize(1);
  model.defaultScene = 0;
  model.scenes[0].nodes.push_back(asset::appendCamera(model, "path", camera));
  asset::saveGlb(model, file);
  return scene::frameCount(camera);
}

void addRecordOptions(CLI::App& command, RecordOptions& o) {
  command.add_option("scene", o.scene, "glTF or GLB file that the path belongs to")->required()->type_name("SCENE.glb");
  command.add_option("-o,--output", o.output, "Write the path as a glTF camera animation, 30 frames per second")
      ->required()
      ->type_name("PATH.glb");
  command
      .add_option("--key", o.keys,
                  "Place the camera at EYE and look at LOOK at this frame, both X,Y,Z; can be given several times, and "
                  "the path runs smoothly through all keys; world units")
      ->type_name("FRAME:EYE:LOOK")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  const auto orbit = [&command, &o](const char* name, auto& target, NumberRange range, const char* help) {
    const auto store = [&o, &target](const auto& value) {
      target = value;
      o.orbitGiven = true;
    };
    limit(command.add_option_function<std::decay_t<decltype(target)>>(name, store, help), range, target);
  };
  orbit("--orbit", o.orbitDegrees, {-36000, 36000}, "Without --key, turn around the scene by this angle; degrees");
  orbit("--elevation", o.elevationDegrees, {-89, 89}, "Elevation of the orbit above the horizontal plane; degrees");
  orbit("--distance", o.distance, {0.001, 1000},
        "Distance of the orbit from the scene's centre; times the distance at which the whole scene is just in view");
  orbit("--frames", o.frames, {1, kMostFrames}, "Length of the orbit; frames");
  addNumber(command, "--fov", o.fovDegrees, {1, 170}, "Vertical field of view; degrees");
  cli::addForceOption(command, o.replace);
  cli::addMemoryOption(command, o.memory);
  command.add_flag("-q,--quiet", o.quiet, "Print no summary");
  command.footer(R"(Examples:
  jalousie record city.glb -o orbit.glb
      turns once around the scene in ten seconds
  jalousie record city.glb --key 0:0,8,0:-40,4,-20 --key 60:-15,6,-8:-60,4,-30 --key 120:-40,8,-10:0,4,0 -o walk.glb
      passes through three poses
  jalousie compare city.glb --path walk.glb -o report
      measures along this path
Blender and other tools can read the file. Any glTF file with an animated camera can serve as a path.
)");
}

void runRecord(const RecordOptions& options) {
  checkOutputs(std::vector<NamedFile>{{"-o", options.output, OutputKind::kCameraPath}}, std::vector{options.scene},
               options.replace);
  if (!options.keys.empty() && options.orbitGiven)
    throw Error(ErrorCode::kUsage,
                "--orbit, --elevation, --distance and --frames describe an orbit; they cannot be combined with --key");
  std::vector<KeyPose> keys;
  for (const std::string& text : options.keys)
    keys.push_back(parseKey(text));
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i - 1].frame >= keys[i].frame) throw Error(ErrorCode::kUsage, "--key: the frames must ascend");
  std::uint32_t frames = 0;
  cli::withFile(options.scene, [&] {
    const scene::SceneData scene =
        sceneFor(options, keys.empty() ? options.frames : keys.back().frame - keys.front().frame + 1);
    for (KeyPose& key : keys) {
      key.eye -= scene.originWorld;
      key.look -= scene.originWorld;
    }
    const Aabb& bounds = scene.boundsWorld;
    frames = savePath(keys.empty() ? orbitTrack(options, bounds) : splineTrack(keys, bounds),
                      glm::radians(options.fovDegrees), bounds, scene.originWorld, options.output);
  });
  if (!options.quiet)
    printOutput(fmt::format("{}: {} frames, {:.1f} s\n", oneLine(options.output.string()), frames,
                            static_cast<double>(frames) / static_cast<double>(scene::kPathRate)));
}

}  // namespace jalousie::app
