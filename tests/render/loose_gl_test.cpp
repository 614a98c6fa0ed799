// Points and lines: drawn in every mode, hidden by what lies in front of them, hiding nothing.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/gl_test.h"
#include "support/scenes.h"

namespace jalousie::render {
namespace {

constexpr std::uint32_t kPictureSide = 96;  // pixels
constexpr std::array<std::uint8_t, 3> kRed = {255, 0, 0};
constexpr std::array<std::uint8_t, 3> kGreen = {0, 255, 0};

class LooseGl : public test::GlTest {};

asset::LooseVertex corner(const glm::vec3& position, const glm::vec3& color, const glm::vec3& normal = glm::vec3(0)) {
  return {position, normal, {0, 0}, glm::vec4(color, 1), 0};
}

/// A box on the left of z = 0, a red segment behind it from left to right, 5 x 5 green points in front of it.
asset::SceneFile boxAndSegment() {
  asset::SceneFile file;
  file.materials.emplace_back();
  file.meshes.push_back({"box", {test::box({0.5F, 0.9F, 0.1F})}});
  file.chains.push_back({"box", {{0, 0.0F}}});
  test::addInstance(file, 0, {-0.5F, 0, 0}, glm::vec3(1));
  asset::LooseGeometry geometry;
  geometry.lines = {corner({-0.9F, 0.3F, -0.5F}, {1, 0, 0}), corner({0.9F, 0.3F, -0.5F}, {1, 0, 0})};
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column)
      geometry.points.push_back(
          corner({-0.8F + 0.1F * static_cast<float>(column), 0.1F * static_cast<float>(row - 6), 0.4F}, {0, 1, 0}));
  file.looseGeometries.push_back(geometry);
  file.looseInstances.push_back({0, glm::mat4(1.0F), 0});
  return file;
}

scene::Camera frontCamera(const scene::SceneData& scene) {
  scene::Camera camera = scene::lookAt({0, 0, 2}, {0, 0, 0}, scene.boundsWorld);
  camera.fovY = glm::radians(60.0F);
  return camera;
}

/// Columns of the picture that hold a colour, and how many pixels have it.
struct Found {
  std::uint32_t first = kPictureSide;
  std::uint32_t last = 0;
  std::size_t pixels = 0;
};

Found find(const ImageRgba8& image, const std::array<std::uint8_t, 3>& color) {
  Found found;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      if (!std::equal(color.begin(), color.end(), &image.pixels[image.offset(x, y)])) continue;
      found.first = std::min(found.first, x);
      found.last = std::max(found.last, x);
      ++found.pixels;
    }
  }
  return found;
}

TEST_F(LooseGl, EveryModeShowsWhatLiesInFront) {
  const scene::SceneData scene = scene::buildScene(boxAndSegment());
  const scene::Camera camera = frontCamera(scene);
  FrameRenderer renderer(scene, kPictureSide, kPictureSide);
  for (const CullModeRow& row : cullModeTable()) {
    FrameOptions options;
    options.cullMode = row.id;
    renderer.resetHistory();
    for (int frame = 0; frame < 3; ++frame)
      renderer.render(options, camera, camera);
    const ImageRgba8 image = renderer.readImage();
    const Found line = find(image, kRed);
    EXPECT_GE(line.first, kPictureSide / 2) << row.name << ": the left half lies behind the box";
    EXPECT_GT(line.pixels, 15U) << row.name;
    EXPECT_EQ(line.pixels, line.last - line.first + 1) << row.name << ": one pixel in each column";
    EXPECT_EQ(find(image, kGreen).pixels, 25U) << row.name;
    const FrameStatistics statistics = renderer.readStatistics();
    EXPECT_EQ(statistics.objects, 1U);
    EXPECT_EQ(statistics.triangles, 12U);
    renderer.renderIds();
    for (const std::uint32_t id : renderer.readIds())
      ASSERT_LE(id, 1U) << "points and lines belong to no object";
  }
}

TEST_F(LooseGl, SceneOfPointsAloneIsDrawn) {
  asset::SceneFile file = boxAndSegment();
  file.instances.clear();
  file.looseInstances[0].instance.reset();
  const scene::SceneData scene = scene::buildScene(file);
  const scene::Camera camera = frontCamera(scene);
  FrameRenderer renderer(scene, kPictureSide, kPictureSide);
  renderer.render({}, camera, camera);
  const ImageRgba8 image = renderer.readImage();
  EXPECT_EQ(find(image, kGreen).pixels, 25U);
  EXPECT_LT(find(image, kRed).first, kPictureSide / 4) << "nothing is in front of the segment";
}

TEST_F(LooseGl, NormalsAreLitAndObjectViewsAreGrey) {
  asset::SceneFile file = boxAndSegment();
  for (asset::LooseVertex& point : file.looseGeometries[0].points)
    point.normal = {0, 0, 1};
  const scene::SceneData scene = scene::buildScene(file);
  const scene::Camera camera = frontCamera(scene);
  FrameRenderer renderer(scene, kPictureSide, kPictureSide);
  renderer.render({}, camera, camera);
  EXPECT_EQ(find(renderer.readImage(), kGreen).pixels, 0U) << "light changes the colour";
  FrameOptions levels;
  levels.view = View::kLod;
  renderer.render(levels, camera, camera);
  const ImageRgba8 image = renderer.readImage();
  EXPECT_EQ(find(image, kRed).pixels, 0U);
  constexpr std::array<std::uint8_t, 3> kGrey = {160, 160, 160};  // sRGB of palette.h's kColorLoose, 0.35
  EXPECT_GT(find(image, kGrey).pixels, 40U) << "25 points and the segment";
}

}  // namespace
}  // namespace jalousie::render
