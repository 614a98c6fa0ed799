// Cameras and their tracks.
#include "asset/scene_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <utility>

#include "asset/accessor.h"
#include "asset/camera_validate.h"
#include "asset/node_graph.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

[[noreturn]] void malformed(const std::string& message) {
  throw Error(ErrorCode::kMalformed, message);
}

/// STEP holds a value until the next key: doubling the keys says the same in linear terms.
template <class Value>
void doubleKeys(std::vector<float>& times, std::vector<Value>& values) {
  if (times.empty()) return;
  const std::size_t count = times.size();
  times.resize(2 * count - 1);
  values.resize(2 * count - 1);
  for (std::size_t i = count; i-- > 1;) {
    times[2 * i] = times[2 * i - 1] = times[i];
    values[2 * i] = values[i];
    values[2 * i - 1] = values[i - 1];
  }
}

std::vector<glm::vec3> readTranslations(const tinygltf::Model& model, int accessor, std::uint64_t maxElements) {
  std::vector<glm::vec3> values = readVec3(model, accessor, maxElements);
  for (const glm::vec3& v : values) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) malformed("animation is not finite");
  }
  return values;
}

/// Whether a transform turns and moves, and does nothing else.
bool isRigid(const glm::dmat4& transform) {
  constexpr double kTolerance = 1e-5;
  const glm::dmat3 axes(transform);
  const glm::dmat3 product = glm::transpose(axes) * axes;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(product[i][k] - (i == k ? 1.0 : 0.0)) <= kTolerance)) return false;
  return glm::determinant(axes) > 0.0;
}

/// The transform without scale, shear and mirroring: the view direction stays, and the plane of the upward axis.
glm::dmat4 rigid(const glm::dmat4& transform) {
  const glm::dvec3 back(transform[2]);
  const glm::dvec3 upward(transform[1]);
  const glm::dvec3 z = back / glm::length(back);
  const glm::dvec3 across = upward - z * glm::dot(z, upward);
  const glm::dvec3 y = across / glm::length(across);
  const glm::dvec3 x = glm::cross(y, z);
  glm::dmat4 result(glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0), transform[3]);
  if (!isFinite(result)) malformed("a camera's transform has no inverse");
  return result;
}

void readLens(const tinygltf::Camera& source, Camera& camera) {
  if (source.type == "perspective") {
    camera.fovY = static_cast<float>(source.perspective.yfov);
    camera.zNear = static_cast<float>(source.perspective.znear);
    if (source.perspective.zfar > 0.0) camera.zFar = static_cast<float>(source.perspective.zfar);
    return;
  }
  const tinygltf::OrthographicCamera& lens = source.orthographic;
  camera.halfSize = glm::abs(glm::vec2(lens.xmag, lens.ymag));
  camera.zNear = static_cast<float>(lens.znear);
  camera.zFar = static_cast<float>(lens.zfar);
}

}  // namespace

CameraReader::CameraReader(const tinygltf::Model& model, const Limits& limits, NodeMotion& motion)
    : model_(model), limits_(limits), motion_(motion), parents_(parentsOf(model)) {}

template <class Value, class Read>
const CameraReader::Keys<Value>& CameraReader::keysOf(KeyTable<Value>& table, const tinygltf::AnimationSampler& sampler,
                                                      const Read& read) {
  const auto [place, isNew] = table.try_emplace({sampler.input, sampler.output, sampler.interpolation});
  Keys<Value>& keys = place->second;
  if (!isNew) return keys;
  const std::uint64_t maxElements = limits_.maxAccessorElements;
  std::vector<float> times = readScalars(model_, sampler.input, maxElements);
  requireAscending(times);
  std::vector<Value> values = read(model_, sampler.output, maxElements);
  if (times.size() != values.size()) malformed("animation has different numbers of times and values");
  if (sampler.interpolation == "STEP") doubleKeys(times, values);
  keys = {std::move(times), std::move(values)};
  return keys;
}

CameraTrack CameraReader::trackOf(int node) {
  CameraTrack track;
  if (const tinygltf::AnimationSampler* sampler = motion_.samplerOf(node, "translation")) {
    const Keys<glm::vec3>& keys = keysOf(positions_, *sampler, readTranslations);
    track.translationTimes = keys.times;
    track.translations = keys.values;
  }
  if (const tinygltf::AnimationSampler* sampler = motion_.samplerOf(node, "rotation")) {
    const Keys<glm::quat>& keys = keysOf(rotations_, *sampler, readQuaternions);
    track.rotationTimes = keys.times;
    track.rotations = keys.values;
  }
  return track;
}

bool CameraReader::hasPlainTrack(int node, const glm::dmat4& worldFromParent) const {
  if (motion_.samplerOf(node, "scale") != nullptr || !isRigid(worldFromParent)) return false;
  for (int above = parents_[static_cast<std::size_t>(node)]; above >= 0;
       above = parents_[static_cast<std::size_t>(above)])
    if (motion_.moves(above)) return false;
  const auto isSpline = [&](const char* property) {
    const tinygltf::AnimationSampler* sampler = motion_.samplerOf(node, property);
    return sampler != nullptr && sampler->interpolation == "CUBICSPLINE";
  };
  return !isSpline("translation") && !isSpline("rotation");
}

glm::dmat4 CameraReader::poseAt(int node, double seconds) {
  glm::dmat4 world(1.0);
  for (int at = node; at >= 0; at = parents_[static_cast<std::size_t>(at)])
    world = motion_.transformAt(at, seconds) * world;
  return rigid(world);
}

CameraTrack CameraReader::sampledTrack(int node, glm::dvec3& start) {
  constexpr std::uint64_t kMostFrames = 1ULL << 20U;  // of all cameras: 36 MB
  float last = 0.0F;
  for (int at = node; at >= 0; at = parents_[static_cast<std::size_t>(at)])
    last = std::max(last, motion_.lastKey(at));
  CameraTrack track;
  if (!(last > 0.0F)) return track;
  const double frames = std::ceil(static_cast<double>(last) * kSampleRate);
  if (!(frames < static_cast<double>(kMostFrames - sampledFrames_)))
    throw Error(ErrorCode::kLimit, fmt::format("the cameras' paths have more than {} frames", kMostFrames));
  sampledFrames_ += static_cast<std::uint64_t>(frames) + 1;
  std::vector<float> times;
  std::vector<glm::vec3> translations;
  std::vector<glm::quat> rotations;
  for (std::uint64_t frame = 0; frame <= static_cast<std::uint64_t>(frames); ++frame) {
    const double seconds = static_cast<double>(frame) / kSampleRate;
    glm::dmat4 pose = poseAt(node, seconds);
    if (frame == 0) start = glm::dvec3(pose[3]);
    pose[3] -= glm::dvec4(start, 0.0);
    times.push_back(static_cast<float>(seconds));
    translations.emplace_back(pose[3]);
    rotations.emplace_back(glm::quat_cast(glm::dmat3(pose)));
    if (rotations.size() > 1 && glm::dot(rotations.back(), rotations[rotations.size() - 2]) < 0.0F)
      rotations.back() = -rotations.back();
  }
  track.translationTimes = times;
  track.rotationTimes = std::move(times);
  track.translations = std::move(translations);
  track.rotations = std::move(rotations);
  return track;
}

Camera CameraReader::read(int node, const glm::dmat4& worldFromParent, const glm::dmat4& worldFromNode) {
  const int index = model_.nodes[static_cast<std::size_t>(node)].camera;
  const tinygltf::Camera& source = model_.cameras[static_cast<std::size_t>(index)];
  validateLens(source, static_cast<std::size_t>(index));
  Camera camera;
  camera.name = source.name.empty() ? model_.nodes[static_cast<std::size_t>(node)].name : source.name;
  readLens(source, camera);
  camera.worldFromCamera = isRigid(worldFromNode) ? worldFromNode : rigid(worldFromNode);
  if (hasPlainTrack(node, worldFromParent)) {
    camera.worldFromParent = worldFromParent;
    camera.track = trackOf(node);
  } else {
    glm::dvec3 start(0.0);
    camera.track = sampledTrack(node, start);
    camera.worldFromParent[3] = glm::dvec4(start, 1.0);
  }
  return camera;
}

}  // namespace jalousie::asset::detail
