// Debug views against what they are said to show.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/random.h"
#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "shared/palette.h"
#include "support/gl_test.h"
#include "support/scenes.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kSide = 128;

class ViewsGl : public test::GlTest {};

int srgbByte(float linear) {
  const float encoded = linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
  return static_cast<int>(std::lround(255.0F * std::clamp(encoded, 0.0F, 1.0F)));
}

/// heatColor() of shaders/lib/palette.glsl.
glm::vec3 heat(float t) {
  const glm::vec3 low(gpu::kColorHeatLow);
  const glm::vec3 middle(gpu::kColorHeatMiddle);
  const glm::vec3 high(gpu::kColorHeatHigh);
  return t < 0.5F ? glm::mix(low, middle, 2.0F * t) : glm::mix(middle, high, 2.0F * t - 1.0F);
}

/// A wall of 2 * cells^2 triangles of equal size, seen from the front.
scene::SceneData wall(std::uint32_t cells) {
  asset::SceneFile file;
  file.materials.emplace_back();
  Random random(1);
  file.meshes.push_back({"wall", {test::perforatedWall(cells, 0.0F, random)}});
  file.chains.push_back({"wall", {{0, 0.0F}}});
  file.instances.push_back({0, glm::mat4(1.0F)});
  return scene::buildScene(file);
}

TEST_F(ViewsGl, DensityIsTrianglesPerPixel) {
  for (const std::uint32_t cells : {2U, 12U, 40U}) {
    const scene::SceneData scene = wall(cells);
    FrameRenderer renderer(scene, kSide, kSide);
    FrameOptions options;
    options.view = View::kDensity;
    const scene::Camera camera = scene::lookAt({0.0F, 0.0F, 3.0F}, glm::vec3(0.0F), scene.boundsWorld);
    renderer.render(options, camera, camera);
    const ImageRgba8 image = renderer.readImage();
    renderer.renderIds();
    const std::vector<std::uint32_t> ids = renderer.readIds();
    const auto covered = static_cast<float>(std::count(ids.begin(), ids.end(), 1U));
    ASSERT_GT(covered, 1000.0F);
    const float density = 2.0F * static_cast<float>(cells * cells) / covered;
    const float t = std::log2(density / gpu::kLeastDensity) / std::log2(gpu::kMostDensity / gpu::kLeastDensity);
    const glm::vec3 expected = heat(std::clamp(t, 0.0F, 1.0F));
    const std::uint8_t* middle = &image.pixels[image.offset(kSide / 2 + 3, kSide / 2 + 1)];
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(middle[channel], srgbByte(expected[channel]), 6) << cells << " cells, channel " << channel;
      EXPECT_EQ(image.pixels[static_cast<std::size_t>(channel)], 0) << "black where nothing is drawn";
    }
  }
}

TEST_F(ViewsGl, LevelsHaveDifferentColours) {
  std::set<std::uint32_t> colors;
  for (const gpu::vec4* color : {&gpu::kColorLevel0, &gpu::kColorLevel1, &gpu::kColorLevel2, &gpu::kColorLevel3,
                                 &gpu::kColorLevel4, &gpu::kColorLevel5, &gpu::kColorLevel6, &gpu::kColorLevel7,
                                 &gpu::kColorLevel8, &gpu::kColorLevel9, &gpu::kColorLevel10, &gpu::kColorLevel11})
    colors.insert(static_cast<std::uint32_t>(srgbByte(color->x) << 16 | srgbByte(color->y) << 8 | srgbByte(color->z)));
  EXPECT_EQ(colors.size(), gpu::kLevelColors);
}

TEST_F(ViewsGl, ALevelHasItsColourWhateverTheLengthOfTheChain) {
  // The hue of the middle pixel: flat shading scales a colour, so its channels keep their ratios.
  const auto middleOf = [](std::uint32_t levels, float tau) {
    asset::SceneFile file = test::sphereChain(levels);
    test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
    const scene::SceneData scene = scene::buildScene(file);
    FrameRenderer renderer(scene, kSide, kSide);
    FrameOptions options;
    options.cullMode = CullMode::kFrustum;
    options.lodRule = LodRule::kPixelError;
    options.tau = tau;
    options.view = View::kLevels;
    const scene::Camera camera = scene::lookAt({0.0F, 0.0F, 3.0F}, glm::vec3(0.0F), scene.boundsWorld);
    renderer.render(options, camera, camera);
    const ImageRgba8 image = renderer.readImage();
    const std::uint8_t* at = &image.pixels[image.offset(kSide / 2, kSide / 2)];
    return std::pair(renderer.readStates()[0].lod, std::array<int, 3>{at[0], at[1], at[2]});
  };
  const auto [fine, blue] = middleOf(4, 0.0F);
  const auto [coarse, orange] = middleOf(2, 1000.0F);
  ASSERT_EQ(fine, 0U);
  ASSERT_EQ(coarse, 1U);
  EXPECT_GT(blue[2], blue[0]);
  EXPECT_GT(orange[0], orange[2]) << "level 1 is not the coarsest colour of a ramp";
  EXPECT_EQ(middleOf(2, 0.0F).second, blue);
}

}  // namespace
}  // namespace jalousie::render
