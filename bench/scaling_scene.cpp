// Everything is seeded: the same count gives the same scene.
#include "scaling_scene.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/random.h"
#include "policy/frame_policy.h"
#include "support/scenes.h"

namespace jalousie::bench {
namespace {

/// Half side of the cube. Camera and wall scale with it, so that every count gives a similar view.
float halfSide(const scene::SceneData& scene) {
  return std::cbrt(static_cast<float>(scene.objects.size()));
}

}  // namespace

scene::SceneData makeScalingScene(std::uint32_t count) {
  asset::SceneFile file = test::sphereChain(5);
  for (std::uint32_t level = 5; level < 10; ++level)
    file.chains[0].levels.push_back({4, 0.4F * static_cast<float>(level)});
  Random random(7);
  const float side = std::cbrt(static_cast<float>(count));
  for (std::uint32_t i = 0; i < count; ++i)
    test::addInstance(file, 0, {random.uniform(-side, side), random.uniform(-side, side), random.uniform(-side, side)},
                      {random.below(8) == 0 ? -0.3F : 0.3F, 0.3F, random.uniform(0.1F, 0.6F)}, random.uniform(0, 6));
  return scene::buildScene(file);
}

scene::Camera scalingCamera(const scene::SceneData& scene) {
  return scene::lookAt({0.1F, 0.2F, 1.3F * halfSide(scene)}, {0, 0, 0}, scene.boundsWorld);
}

gl::Texture makeWallDepth(const scene::SceneData& scene) {
  constexpr std::uint32_t kCell = 32;  // pixels
  const float wallDepth = scalingCamera(scene).zNear / (0.8F * halfSide(scene));
  gl::Texture depth(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, {kScalingWidth, kScalingHeight, 1, 1}, "wall");
  Random random(3);
  std::vector<float> values(std::size_t{kScalingWidth} * kScalingHeight);
  std::vector<bool> open(std::size_t{kScalingWidth / kCell + 1} * (kScalingHeight / kCell + 1));
  for (std::size_t i = 0; i < open.size(); ++i)
    open[i] = random.below(5) == 0;
  for (std::uint32_t y = 0; y < kScalingHeight; ++y)
    for (std::uint32_t x = 0; x < kScalingWidth; ++x)
      values[std::size_t{y} * kScalingWidth + x] =
          open[std::size_t{y / kCell} * (kScalingWidth / kCell + 1) + x / kCell] ? 0.0F : wallDepth;
  glTextureSubImage2D(depth.id(), 0, 0, 0, kScalingWidth, kScalingHeight, GL_DEPTH_COMPONENT, GL_FLOAT, values.data());
  return depth;
}

gpu::CullView scalingView(const scene::SceneData& scene, std::uint32_t mapLevels) {
  const scene::Camera camera = scalingCamera(scene);
  gpu::CullView view{};
  view.clipFromWorld = scene::clipFromWorld(camera, static_cast<float>(kScalingWidth) / kScalingHeight);
  view.cameraWorld = glm::vec4(camera.positionWorld(), camera.zNear);
  view.viewportWidth = kScalingWidth;
  view.viewportHeight = kScalingHeight;
  view.objectCount = static_cast<gpu::uint>(scene.objects.size());
  view.traits = traitsOf(CullMode::kHiz) | traitsOf(LodRule::kPixelError);
  view.mapLevels = mapLevels;
  view.cullThreshold = 1.0F;
  view.maxTessellation = 20;
  view.focalPixels = scene::focalPixels(camera, {kScalingWidth, kScalingHeight});
  view.tau = 1.0F;
  return view;
}

CopyPass::CopyPass(const gl::Buffer& source, std::uint32_t count)
    : source_(source), count_(count), target_(source.sizeBytes(), 0, "copy") {
  const char* text = R"(#version 450 core
layout(local_size_x = 64) in;
struct Transform { vec4 row0; vec4 row1; vec4 row2; };
layout(std430, binding = 0) readonly buffer Source { Transform source[]; };
layout(std430, binding = 1) writeonly buffer Target { Transform target[]; };
void main() {
  uint id = gl_GlobalInvocationID.x;
  if (id < uint(source.length())) target[id] = source[id];
})";
  program_ = gl::Handle<gl::ProgramTraits>(glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text));
}

void CopyPass::run() const {
  glUseProgram(program_.id());
  source_.bindStorage(0);
  target_.bindStorage(1);
  glDispatchCompute((count_ + 63) / 64, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

bool CopyPass::isRight() const {
  return target_.read<std::byte>(target_.sizeBytes()) == source_.read<std::byte>(source_.sizeBytes());
}

}  // namespace jalousie::bench
