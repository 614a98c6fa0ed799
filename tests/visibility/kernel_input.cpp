// Seeded input for the tests of the kernels.
#include "visibility/kernel_input.h"

#include "core/random.h"
#include "shared/limits.h"
#include "support/scenes.h"

namespace jalousie::visibility {

gpu::CullView makeView(const scene::SceneData& scene, const scene::Camera& camera, ScreenSize size,
                       float occluderDistance, const FramePolicy& policy) {
  gpu::CullView view{};
  view.clipFromWorld = scene::clipFromWorld(camera, static_cast<float>(size.width) / static_cast<float>(size.height));
  view.cameraWorld = glm::vec4(camera.positionWorld(), camera.zNear);
  view.forwardWorld = glm::vec4(camera.forwardWorld(), camera.isOrthographic() ? 1.0F : 0.0F);
  view.viewportWidth = size.width;
  view.viewportHeight = size.height;
  view.objectCount = static_cast<gpu::uint>(scene.objects.size());
  view.traits = traitsOf(policy);
  view.analyse = 1;
  view.mapLevels = mapLayout(size.width, size.height).levels;
  view.occluderDistance = occluderDistance;
  view.cullThreshold = 1.0F;
  view.maxTessellation = gpu::kMaxTessellationLevel;
  view.focalPixels = scene::focalPixels(camera, {size.width, size.height});
  view.tau = 1.0F;
  view.maxError = gpu::kDefaultMaxError;
  view.hysteresis = gpu::kDefaultHysteresis;
  view.fadeFrames = gpu::kDefaultFadeFrames;
  return view;
}

std::vector<float> structuredPixels(ScreenSize size, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> pixels(std::size_t{size.width} * size.height);
  const std::uint32_t cell = 1U << random.below(5);
  for (std::uint32_t y = 0; y < size.height; ++y) {
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const std::uint32_t tile = (x / cell) * 7919U + (y / cell) * 104729U + static_cast<std::uint32_t>(seed);
      pixels[std::size_t{y} * size.width + x] = tile % 5 < 2 || random.below(50) == 0 ? 1.0F : 0.0F;
    }
  }
  return pixels;
}

std::vector<float> structuredDepth(ScreenSize size, std::uint64_t seed) {
  Random random(seed);
  const std::vector<float> open = structuredPixels(size, seed);
  std::vector<float> depth(open.size());
  for (std::size_t i = 0; i < depth.size(); ++i)
    depth[i] = open[i] > 0.0F ? (random.below(3) == 0 ? 0.0F : 0.1F) : random.uniform(0.4F, 0.6F);
  return depth;
}

asset::SceneFile mixedFile(std::uint32_t count) {
  asset::SceneFile file = test::randomSpheres(count, 5.0F, 3);
  file.materials.resize(3, file.materials.front());
  file.materials[1].doubleSided = true;
  file.materials[2].alphaMode = asset::AlphaMode::kBlend;
  file.meshes.push_back(
      {"box with all", {test::box(glm::vec3(1.0F), 1), test::box(glm::vec3(0.5F), 0), test::box(glm::vec3(1.2F), 2)}});
  file.chains.push_back({"box", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  for (std::size_t i = 0; i < file.instances.size(); i += 3)
    file.instances[i].chain = 1;
  return file;
}

}  // namespace jalousie::visibility
