// Stored frames of the method of the thesis and of all kinds of surfaces. views_golden_gl_test.cpp stores the default
// mode under every view. The limits are the usual ones of ImageLimits, which states their reasons.
#include <gtest/gtest.h>

#include "render/frame_renderer.h"
#include "support/gl_test.h"
#include "support/image_compare.h"
#include "support/stages.h"

namespace jalousie::render {
namespace {

class GoldenGl : public test::GlTest {
 protected:
  /// The thesis' pipeline, whatever else the options say.
  static ImageRgba8 frame(FrameOptions options) {
    options.cullMode = CullMode::kHom;
    options.lodRule = LodRule::kLinear;
    options.lvMeasure = LvMeasure::kThesis;
    const scene::SceneData scene =
        scene::buildScene(test::spheresBehindWall(0.35F), {.patches = options.detail == Detail::kTessellation});
    FrameRenderer renderer(scene, 320, 180);
    const scene::Camera camera = test::cameraBeforeWall(scene.boundsWorld);
    options.occluderDistance = test::kWallOccluderDistance;
    renderer.render(options, camera, camera);
    return renderer.readImage();
  }
};

TEST_F(GoldenGl, Shaded) {
  EXPECT_TRUE(test::matchesGolden(frame({}), "wall_shaded"));
}

TEST_F(GoldenGl, LodView) {
  FrameOptions options;
  options.view = View::kLod;
  EXPECT_TRUE(test::matchesGolden(frame(options), "wall_lod"));
}

TEST_F(GoldenGl, LvView) {
  FrameOptions options;
  options.view = View::kLv;
  EXPECT_TRUE(test::matchesGolden(frame(options), "wall_lv"));
}

TEST_F(GoldenGl, OcclusionMapView) {
  FrameOptions options;
  options.view = View::kOcclusion;
  EXPECT_TRUE(test::matchesGolden(frame(options), "wall_occlusion"));
  options.mapLevel = 3;
  EXPECT_TRUE(test::matchesGolden(frame(options), "wall_occlusion_level3"));
}

TEST_F(GoldenGl, Tessellation) {
  FrameOptions options;
  options.detail = Detail::kTessellation;
  options.maxTessellation = 12;  // below every driver's limit for the wall's many patches
  options.view = View::kLod;
  EXPECT_TRUE(test::matchesGolden(frame(options), "wall_tessellation_lod"));
}

TEST_F(GoldenGl, MaskedBlendedMirroredAndTexturedSurfaces) {
  asset::SceneFile file = test::sphereChain(1);
  ImageRgba8 checker{8, 8, std::vector<std::uint8_t>(256)};
  for (std::uint32_t i = 0; i < 64; ++i) {
    const bool dark = ((i ^ (i >> 3)) & 1U) != 0;
    const std::uint8_t texel[4] = {static_cast<std::uint8_t>(dark ? 40 : 230), 160, 60,
                                   static_cast<std::uint8_t>(dark ? 20 : 255)};
    std::copy_n(texel, 4, checker.pixels.begin() + 4 * i);
  }
  file.images.edit().push_back(checker);
  for (const asset::AlphaMode mode : {asset::AlphaMode::kOpaque, asset::AlphaMode::kMask, asset::AlphaMode::kBlend}) {
    asset::Material material;
    material.baseTexture.emplace();
    material.alphaMode = mode;
    material.doubleSided = mode != asset::AlphaMode::kOpaque;
    const auto index = static_cast<std::uint32_t>(file.materials.size());
    file.materials.push_back(material);
    file.meshes.push_back({"box", {test::box(glm::vec3(0.7F), index)}});
    file.chains.push_back({"box", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
    const float x = 2.0F * (static_cast<float>(index) - 2.0F);
    test::addInstance(file, index, {x, 1, 0}, glm::vec3(1), 0.7F, {1, 1, 0});
    test::addInstance(file, index, {x, -1, 0}, {-1, 1, 1}, 0.7F, {1, 1, 0});
  }
  const scene::SceneData scene = scene::buildScene(file);
  FrameRenderer renderer(scene, 320, 180);
  const scene::Camera camera = scene::lookAt({0, 0, 6}, {0, 0, 0}, scene.boundsWorld);
  FrameOptions options;
  options.cullMode = CullMode::kFrustum;
  options.lodRule = LodRule::kFinest;
  renderer.render(options, camera, camera);
  EXPECT_TRUE(test::matchesGolden(renderer.readImage(), "surfaces"));
}

/// Textures of every class side by side: neighbouring fragments fetch from different arrays.
TEST_F(GoldenGl, TexturesOfDifferentSizesKeepTheirColours) {
  const std::uint8_t colors[4][3] = {{230, 20, 20}, {20, 230, 20}, {20, 20, 230}, {230, 230, 20}};
  const std::uint32_t sizes[4][2] = {{256, 256}, {512, 16}, {8, 256}, {64, 64}};
  asset::SceneFile file = test::sphereChain(1);
  for (std::uint32_t i = 0; i < 4; ++i) {
    ImageRgba8 image{sizes[i][0], sizes[i][1],
                     std::vector<std::uint8_t>(std::size_t{4} * sizes[i][0] * sizes[i][1], 255)};
    for (std::size_t p = 0; p < image.pixels.size(); ++p)
      if (p % 4 < 3) image.pixels[p] = colors[i][p % 4];
    file.images.edit().push_back(image);
    asset::Material material;
    material.baseTexture.emplace().image = i;
    file.materials.push_back(material);
    file.meshes.push_back({"box", {test::box(glm::vec3(0.5F), i + 1)}});
    file.chains.push_back({"box", {{i + 1, 0.0F}}});
    test::addInstance(file, i + 1, {static_cast<float>(i % 2) - 0.5F, i < 2 ? -0.5F : 0.5F, 0}, glm::vec3(1));
  }
  const scene::SceneData scene = scene::buildScene(file);
  ASSERT_GT(scene.textures.layout.classes.size(), 1U);
  FrameRenderer renderer(scene, 64, 64);
  const scene::Camera camera = scene::lookAt({0, 0, 3}, {0, 0, 0}, scene.boundsWorld);
  FrameOptions options;
  options.cullMode = CullMode::kFrustum;
  options.lodRule = LodRule::kFinest;
  renderer.render(options, camera, camera);
  const ImageRgba8 picture = renderer.readImage();
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint8_t* pixel = &picture.pixels[picture.offset(i % 2 == 0 ? 25 : 38, i / 2 == 0 ? 38 : 25)];
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(pixel[c] > 90, colors[i][c] > 90) << "box " << i << ", channel " << c << ": " << int{pixel[c]};
  }
}

}  // namespace
}  // namespace jalousie::render
