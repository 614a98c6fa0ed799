// The reference draws every object; what it shows of an object that a mode left out is an error.
#include "support/culling.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "core/check.h"
#include "core/random.h"
#include "support/scenes.h"
#include "visibility/frame_counters.h"

namespace jalousie::test {
namespace {

Aabb boundsWorld(const scene::SceneData& scene, std::size_t object) {
  const gpu::Chain& chain = scene.chains[scene.objects[object].chain];
  return transformed(scene::worldFromObject(scene.transforms[scene.objects[object].transform]),
                     Aabb{glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)});
}

/// A point beside a random object, about its own size away.
glm::vec3 placeNear(const scene::SceneData& scene, Random& random) {
  const Aabb box = boundsWorld(scene, random.below(static_cast<std::uint32_t>(scene.objects.size())));
  const glm::vec3 offset(random.uniform(-1, 1), random.uniform(0, 1), random.uniform(-1, 1));
  return box.center() + 0.7F * box.diagonal() * offset;
}

void addLoss(CullingLoss& loss, const std::vector<std::uint32_t>& ids, const std::vector<gpu::uint>& marks,
             gpu::uint traits) {
  std::uint64_t wrong = 0;
  for (const std::uint32_t id : ids)
    wrong += id > 0 && !visibility::isDrawn(marks[id - 1], traits) ? 1 : 0;
  loss.wrongPixels += wrong;
  loss.worstFrame = std::max(loss.worstFrame, wrong);
}

}  // namespace

CullingLoss countLoss(const Journey& journey, std::uint32_t width, std::uint32_t height,
                      const render::FrameOptions& options, std::uint32_t firstFrame, std::uint32_t frames) {
  JAL_CHECK(!rowOf(options.lodRule).followsLv);
  render::FrameRenderer renderer(journey.scene, width, height);
  render::FrameRenderer reference(journey.scene, width, height);
  render::FrameOptions everything = options;
  everything.cullMode = CullMode::kFull;
  render::FrameOptions culling = options;
  everything.skipDraw = true;  // renderIds draws it
  std::vector<gpu::Transform> transforms = journey.scene.transforms;
  CullingLoss loss;
  for (std::uint32_t frame = firstFrame; frame < firstFrame + frames; ++frame) {
    const scene::Camera camera = journey.camera(frame);
    if (journey.move) {
      journey.move(frame, transforms);
      renderer.setTransforms(0, transforms);
      reference.setTransforms(0, transforms);
    }
    culling.seconds = everything.seconds = scene::secondsAt(static_cast<float>(frame));
    renderer.render(culling, camera, camera);
    const std::vector<float> depth = renderer.readDepth();
    reference.render(everything, camera, camera);
    reference.renderIds();
    const std::vector<float> expectedDepth = reference.readDepth();
    for (std::size_t pixel = 0; pixel < depth.size(); ++pixel)
      loss.differentDepths += depth[pixel] != expectedDepth[pixel] ? 1 : 0;
    addLoss(loss, reference.readIds(), renderer.readMarks(), traitsOf(options.cullMode));
    const render::FrameStatistics statistics = renderer.readStatistics();
    loss.culled += statistics.culledOcclusion;
    loss.triangles += statistics.triangles;
    loss.referenceTriangles += reference.readStatistics().triangles;
    ++loss.frames;
  }
  return loss;
}

std::function<scene::Camera(std::uint32_t frame)> tour(const scene::SceneData& scene, std::uint32_t framesEach,
                                                       std::uint64_t seed) {
  Random random(seed);
  const Aabb bounds = scene.boundsWorld;
  std::vector<glm::vec3> places;
  for (std::uint32_t i = 0; i < 2 * framesEach + 8; ++i)
    places.push_back(placeNear(scene, random));
  return [=](std::uint32_t frame) {
    const std::uint32_t kind = frame / framesEach % 4;
    const std::uint32_t step = frame % framesEach;
    const float share = static_cast<float>(step) / static_cast<float>(framesEach);
    const float turn = 2.0F * std::numbers::pi_v<float>;
    if (kind == 0) {
      const float angle = turn * share;
      const glm::vec3 offset(std::sin(angle), 0.2F + 0.3F * share, std::cos(angle));
      return scene::lookAt(bounds.center() + 0.75F * bounds.diagonal() * offset, bounds.center(), bounds);
    }
    if (kind == 1) {
      const float along = 3.0F * share;  // past four places
      const auto leg = static_cast<std::size_t>(along);
      const glm::vec3 eye = glm::mix(places[leg], places[leg + 1], along - static_cast<float>(leg));
      return scene::lookAt(eye, places[leg + 1] + 1e-3F * bounds.diagonal() * glm::vec3(0.3F, 0.1F, 1.0F), bounds);
    }
    if (kind == 2) {
      const float angle = 0.7F * static_cast<float>(step);  // 40 degrees a frame
      return scene::lookAt(places[5], places[5] + glm::vec3(std::sin(angle), 0.2F * std::cos(angle), std::cos(angle)),
                           bounds);
    }
    return scene::lookAt(places[6 + 2 * step], places[7 + 2 * step], bounds);
  };
}

std::function<void(std::uint32_t frame, std::span<gpu::Transform>)> swingObjects(const scene::SceneData& scene,
                                                                                 std::uint32_t stride) {
  return [&scene, stride](std::uint32_t frame, std::span<gpu::Transform> transforms) {
    for (std::size_t i = 0; i < scene.objects.size(); i += stride) {
      const gpu::uint transform = scene.objects[i].transform;
      const float phase = 0.9F * static_cast<float>(frame) + static_cast<float>(i);
      const float reach = boundsWorld(scene, i).diagonal();
      const glm::vec3 swing = reach * glm::vec3(std::sin(phase), 0.3F * std::cos(1.3F * phase), std::cos(phase));
      const glm::mat4 rest = scene::worldFromObject(scene.transforms[transform]);
      transforms[transform] = scene::makeTransform(glm::translate(glm::mat4(1.0F), swing) *
                                                   glm::rotate(rest, phase, glm::vec3(0.0F, 1.0F, 0.0F)));
    }
  };
}

asset::SceneFile groundPlane(std::uint32_t count, std::uint64_t seed) {
  asset::SceneFile file = sphereChain(5);
  file.meshes.push_back({"ground", {box({60.0F, 0.1F, 60.0F})}});
  file.chains.push_back({"ground", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  addInstance(file, 1, {0, -0.1F, 0}, glm::vec3(1));
  Random random(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float size = 0.25F * std::pow(12.0F, random.uniform());
    addInstance(file, 0, {random.uniform(-20, 20), size * random.uniform(0.2F, 1.4F), random.uniform(-20, 20)},
                glm::vec3(size), random.uniform(0, 6), {random.uniform(), 1, random.uniform()});
  }
  return file;
}

asset::SceneFile leafCards(std::uint32_t cards, std::uint32_t spheres, std::uint64_t seed) {
  asset::SceneFile file = sphereChain(5);
  Random random(seed);
  ImageRgba8 leaves{64, 64, std::vector<std::uint8_t>(64 * 64 * 4)};
  for (std::size_t texel = 0; texel < leaves.pixels.size(); texel += 4) {
    leaves.pixels[texel + 1] = static_cast<std::uint8_t>(90 + random.below(90));
    leaves.pixels[texel + 3] = random.below(24) == 0 ? 0 : 255;
  }
  file.images.edit().push_back(leaves);
  asset::Material material;
  material.baseTexture.emplace();
  material.alphaMode = asset::AlphaMode::kMask;
  material.doubleSided = true;
  file.materials.push_back(material);
  file.meshes.push_back({"card", {perforatedWall(1, -1.0F, random, 1)}});
  file.chains.push_back({"card", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  for (std::uint32_t i = 0; i < cards; ++i)
    addInstance(file, 1, {random.uniform(-8, 8), random.uniform(-3, 3), random.uniform(-4, 4)},
                glm::vec3(random.uniform(1.0F, 2.5F)), random.uniform(-0.5F, 0.5F), {random.uniform(), 1, 0});
  for (std::uint32_t i = 0; i < spheres; ++i)
    addInstance(file, 0, {random.uniform(-9, 9), random.uniform(-4, 4), random.uniform(-9, 9)},
                glm::vec3(random.uniform(0.1F, 0.6F)));
  return file;
}

namespace {

/// Adds a house to the meshes and chains; the ground is y = 0.
void addHouse(asset::SceneFile& file, Random& random, float larger) {
  asset::Chain chain{"house", {{static_cast<std::uint32_t>(file.meshes.size()), 0.0F}}};
  asset::Mesh mesh{"house", {}};
  const std::uint32_t boxes = 1 + random.below(3);
  for (std::uint32_t i = 0; i < boxes; ++i) {
    const glm::vec3 half(random.uniform(1.0F, 4.0F), random.uniform(1.5F, 6.0F), random.uniform(1.0F, 4.0F));
    const glm::vec3 middle(random.uniform(-1.5F, 1.5F), half.y, random.uniform(-1.5F, 1.5F));
    mesh.primitives.push_back(box(half));
    for (glm::vec3& position : mesh.primitives.back().positions)
      position += middle;
    chain.occluders.push_back({solidOf({middle - larger * half, middle + larger * half}), 1});
  }
  file.meshes.push_back(std::move(mesh));
  file.chains.push_back(std::move(chain));
}

}  // namespace

asset::SceneFile town(std::uint32_t houses, std::uint32_t spheres, std::uint64_t seed, float larger,
                      std::uint32_t sphereLevels) {
  constexpr float kInside = 0.45F;  // half the side of a cube in the coarsest level
  asset::SceneFile file = sphereChain(4);
  file.chains[0].occluders = {{solidOf({glm::vec3(-kInside), glm::vec3(kInside)}), sphereLevels}};
  file.meshes.push_back({"ground", {box({60.0F, 0.1F, 60.0F})}});
  file.chains.push_back({"ground", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  addInstance(file, 1, {0, -0.1F, 0}, glm::vec3(1));
  Random random(seed);
  for (std::uint32_t i = 0; i < houses; ++i) {
    addHouse(file, random, larger);
    const glm::vec3 scale((random.below(3) == 0 ? -1.0F : 1.0F) * random.uniform(0.7F, 1.5F),
                          random.uniform(0.7F, 2.0F), random.uniform(0.7F, 1.5F));
    addInstance(file, 2 + i, {random.uniform(-30, 30), 0, random.uniform(-30, 30)}, scale, random.uniform(0, 6));
  }
  for (std::uint32_t i = 0; i < spheres; ++i)
    addInstance(file, 0, {random.uniform(-35, 35), random.uniform(0.2F, 3.0F), random.uniform(-35, 35)},
                glm::vec3(random.uniform(0.2F, 1.0F)), random.uniform(0, 6));
  return file;
}

}  // namespace jalousie::test
