// FNV-1a over the bytes of everything that counts.
#include "compare/fingerprint.h"

#include <fmt/format.h>

#include <cstdint>

#include "asset/scene_file.h"
#include "compare/configuration.h"
#include "scene/scene_data.h"
#include "visibility/importance_mask.h"

namespace jalousie::compare {
namespace {

/// FNV-1a with 64 bits (Fowler, Noll and Vo).
class Hash {
 public:
  void bytes(std::span<const std::byte> data) {
    for (const std::byte b : data)
      state_ = (state_ ^ static_cast<std::uint64_t>(b)) * 0x100000001b3ULL;
  }
  template <class T>
  void values(const std::vector<T>& data) {
    value(data.size());
    bytes(std::as_bytes(std::span(data)));
  }
  template <class T>
  void value(const T& data) {
    bytes(std::as_bytes(std::span(&data, 1)));
  }
  void text(const std::string& data) {
    value(data.size());
    bytes(std::as_bytes(std::span(data.data(), data.size())));
  }
  std::string digits() const { return fmt::format("{:016x}", state_); }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

void addMotion(Hash& hash, const scene::MotionData& motion) {
  hash.values(motion.numbers);
  hash.values(motion.tracks);
  hash.values(motion.nodes);
  hash.values(motion.weights);
  hash.values(motion.targets);
  hash.values(motion.vertices);
  hash.values(motion.influences);
  hash.values(motion.deltas);
  hash.values(motion.chains);
  hash.values(motion.boxes);
  hash.values(motion.deltaBoxes);
}

void addScene(Hash& hash, const scene::SceneData& scene, const asset::Camera& path, const Plan& plan) {
  hash.values(scene.vertices);
  hash.values(scene.indices);
  hash.value(scene.objects.size());
  for (const gpu::Object& object : scene.objects)
    hash.value(scene.transforms[object.transform]);
  hash.value(scene.objects.size());
  for (const gpu::Object& object : scene.objects) {
    hash.value(object.chain);
    hash.value(object.owner);
  }
  hash.values(scene.chains);
  hash.values(scene.lods);
  hash.values(scene.materials);
  addMotion(hash, scene.motion);
  for (const ImageRgba8& image : scene.textures.images) {
    hash.value(image.width);
    hash.value(image.height);
    hash.values(image.pixels);
  }
  hash.value(path.fovY);
  hash.value(path.halfSize.value_or(glm::vec2(0.0F)));
  hash.value(path.zNear);
  hash.value(path.zFar.value_or(0.0F));
  hash.value(path.worldFromCamera);
  hash.value(path.worldFromParent);
  hash.values(path.track.translationTimes.get());
  hash.values(path.track.translations.get());
  hash.values(path.track.rotationTimes.get());
  hash.values(path.track.rotations.get());
  hash.value(plan.width);
  hash.value(plan.height);
  hash.value(plan.reference);
  hash.text(plan.renderer);
  hash.text(plan.build);
}

}  // namespace

std::string digestOf(std::span<const std::byte> bytes) {
  Hash hash;
  hash.bytes(bytes);
  return hash.digits();
}

std::string referenceFingerprint(const scene::SceneData& scene, const asset::Camera& path, const Plan& plan) {
  Hash hash;
  addScene(hash, scene, path, plan);
  return hash.digits();
}

std::string experimentFingerprint(const scene::SceneData& scene, const asset::Camera& path,
                                  const std::vector<Configuration>& configurations, const Plan& plan) {
  Hash hash;
  addScene(hash, scene, path, plan);
  hash.value(plan.range.first);
  hash.value(plan.range.last);
  hash.value(plan.range.step);
  hash.value(plan.lead);
  hash.value(plan.keep);
  hash.value(plan.objects);
  hash.values(plan.taus);
  hash.value(plan.baseline);
  hash.value(plan.gpuTiming);
  hash.value(plan.pixelsPerDegree);
  hash.value(plan.butteraugli);
  for (const Configuration& configuration : configurations) {
    hash.text(configuration.name);
    hash.text(configuration.commandLine);
    if (const visibility::ImportanceMask* mask = configuration.renderer.importance; mask != nullptr)
      hash.bytes(std::as_bytes(mask->level(0)));
  }
  return hash.digits();
}

}  // namespace jalousie::compare
