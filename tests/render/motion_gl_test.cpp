// Kernels that play animations: as their twin, in every mode, without a lost pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "asset/scene_file.h"
#include "gl/shader_source.h"
#include "render/frame_renderer.h"
#include "render/motion_pass.h"
#include "render/scene_buffers.h"
#include "scene/motion_reference.h"
#include "scene/scene_data.h"
#include "support/animated_model.h"
#include "support/culling.h"
#include "support/gl_test.h"
#include "support/image_compare.h"

namespace jalousie::render {
namespace {

using test::AnimatedContent;

class MotionGl : public test::GlTest {};

asset::SceneFile playing(const AnimatedContent& content) {
  return asset::readScene(test::animatedModel(content), "model.glb", {}, {.check = {}, .seconds = {}, .plays = true});
}

/// Boxes of cells without triangles are infinite.
float largestDifference(const glm::vec4& a, const glm::vec4& b) {
  if (a == b) return 0.0F;
  const glm::vec4 difference = glm::abs(a - b);
  return std::max({difference.x, difference.y, difference.z, difference.w});
}

void expectSame(const std::vector<scene::Vertex>& actual, const std::vector<scene::Vertex>& expected, float tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t v = 0; v < actual.size(); ++v) {
    ASSERT_LT(glm::distance(actual[v].position, expected[v].position), tolerance) << v;
    for (int k = 0; k < 3; ++k) {
      const auto part = [k](std::uint32_t packed) { return static_cast<std::int32_t>(packed << (22 - 10 * k)) >> 22; };
      ASSERT_LE(std::abs(part(actual[v].normal) - part(expected[v].normal)), 1) << v;
    }
    ASSERT_EQ(actual[v].uv, expected[v].uv);
    ASSERT_EQ(actual[v].color, expected[v].color);
    ASSERT_EQ(actual[v].material, expected[v].material);
  }
}

void expectSameBoxes(const std::vector<gpu::Chain>& actual, const std::vector<gpu::Chain>& expected, float tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t c = 0; c < actual.size(); ++c) {
    ASSERT_LT(largestDifference(actual[c].boundsMinObject, expected[c].boundsMinObject), tolerance) << c;
    ASSERT_LT(largestDifference(actual[c].boundsMaxObject, expected[c].boundsMaxObject), tolerance) << c;
    ASSERT_EQ(actual[c].firstLod, expected[c].firstLod);
    ASSERT_EQ(actual[c].surfaceObject, expected[c].surfaceObject);
  }
}

/// @param build  with patches or cells
void expectTwin(const AnimatedContent& content, const scene::BuildOptions& build) {
  scene::SceneData scene = scene::buildScene(playing(content), build);
  ASSERT_FALSE(scene.motion.empty());
  SceneBuffers buffers(scene);
  MotionPass pass(scene.motion, gl::ShaderLibrary());
  for (const float seconds : {0.0F, 0.31F, 0.9F, 1.37F, 1.8F, 2.0F, 5.0F}) {
    SCOPED_TRACE(testing::Message() << "seed " << content.seed << " at " << seconds);
    pass.play(seconds, buffers);
    scene::poseScene(scene, seconds);
    constexpr float kTolerance = 2e-4F;
    const auto transforms = buffers.transforms().read<gpu::Transform>(scene.transforms.size());
    for (std::size_t t = 0; t < transforms.size(); ++t) {
      ASSERT_LT(largestDifference(transforms[t].worldFromObject0, scene.transforms[t].worldFromObject0), kTolerance);
      ASSERT_LT(largestDifference(transforms[t].worldFromObject1, scene.transforms[t].worldFromObject1), kTolerance);
      ASSERT_LT(largestDifference(transforms[t].worldFromObject2, scene.transforms[t].worldFromObject2), kTolerance);
    }
    expectSame(buffers.vertices().read<scene::Vertex>(scene.vertices.size()), scene.vertices, kTolerance);
    expectSame(buffers.looseVertices().read<scene::Vertex>(scene.loose.vertices.size()), scene.loose.vertices,
               kTolerance);
    expectSameBoxes(buffers.chains().read<gpu::Chain>(scene.chains.size()), scene.chains, kTolerance);
    expectSameBoxes(buffers.cellChains().read<gpu::Chain>(scene.cells.chains.size()), scene.cells.chains, kTolerance);
    const auto bounds = buffers.cellBounds().read<gpu::CellBounds>(scene.cells.bounds.size());
    for (std::size_t b = 0; b < bounds.size(); ++b)
      ASSERT_LT(largestDifference(bounds[b].maxObject, scene.cells.bounds[b].maxObject), kTolerance) << b;
  }
}

TEST_F(MotionGl, KernelsAgreeWithTheirTwin) {
  expectTwin({.seed = 21}, {});
  expectTwin({.seed = 22, .flat = true, .loose = true}, {});
  expectTwin({.seed = 23, .nodes = 90, .skinned = 5, .morphed = 5, .levels = true}, {.patches = true});
  expectTwin({.seed = 24, .loose = true, .levels = true}, {.cells = {scene::CellOptions::Kind::kCount, 64}});
  expectTwin({.seed = 25, .nodes = 0, .skinned = 0, .morphed = 3}, {});
  expectTwin({.seed = 26, .nodes = 200, .skinned = 0, .morphed = 0}, {});
}

TEST_F(MotionGl, NoModeLosesAPixelOfWhatMoves) {
  for (const AnimatedContent& content :
       {AnimatedContent{.seed = 31, .nodes = 60, .skinned = 8, .morphed = 8, .levels = true},
        AnimatedContent{.seed = 32, .nodes = 80, .skinned = 4, .morphed = 2, .flat = true, .loose = true}}) {
    test::Journey journey{.name = "animated", .scene = scene::buildScene(playing(content)), .camera = {}, .move = {}};
    journey.camera = test::tour(journey.scene, 6, content.seed);
    std::uint64_t culled = 0;
    for (const CullModeRow& row : cullModeTable()) {
      if (!row.culls) continue;
      FrameOptions options = test::pixelErrorOptions();
      options.cullMode = row.id;
      const test::CullingLoss loss = test::countLoss(journey, 160, 90, options, 0, 40);
      if (!row.conservative) continue;
      EXPECT_EQ(loss.wrongPixels, 0U) << row.name;
      culled += loss.culled;
    }
    EXPECT_GT(culled, 0U);
  }
}

TEST_F(MotionGl, PicturesAreThoseOfASceneThatIsReadAtTheTime) {
  const tinygltf::Model model =
      test::animatedModel({.seed = 41, .nodes = 20, .skinned = 3, .morphed = 3, .loose = true});
  const scene::SceneData moving =
      scene::buildScene(asset::readScene(model, "model.glb", {}, {.check = {}, .seconds = {}, .plays = true}));
  FrameRenderer renderer(moving, 200, 150);
  const scene::Camera camera = scene::frameBox(moving.boundsWorld, 4.0F / 3.0F);
  for (const float seconds : {0.0F, 0.6F, 1.1F, 2.0F}) {
    const scene::SceneData still = scene::buildScene(
        asset::readScene(model, "model.glb", {}, {.check = {}, .seconds = static_cast<double>(seconds)}));
    FrameRenderer expected(still, 200, 150);
    FrameOptions options;
    options.cullMode = CullMode::kFull;
    options.seconds = seconds;
    renderer.render(options, camera, camera);
    expected.render(options, camera, camera);
    const ImageRgba8 a = renderer.readImage();
    const ImageRgba8 b = expected.readImage();
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4)
      different += std::abs(static_cast<int>(a.pixels[i]) - static_cast<int>(b.pixels[i])) > 4 ? 1 : 0;
    EXPECT_LT(different, a.pixels.size() / 4 / 200) << "at " << seconds << ": silhouettes move by a rounding";
  }
}

TEST_F(MotionGl, AFrameIsTheSameWheneverItIsShown) {
  const scene::SceneData scene = scene::buildScene(playing({.seed = 51, .levels = true}));
  FrameRenderer renderer(scene, 120, 90);
  const scene::Camera camera = scene::frameBox(scene.boundsWorld, 4.0F / 3.0F);
  FrameOptions options = test::pixelErrorOptions();
  const auto picture = [&](float seconds) {
    options.seconds = seconds;
    renderer.resetHistory();
    renderer.render(options, camera, camera);
    return renderer.readImage().pixels;
  };
  const auto first = picture(0.4F);
  const auto later = picture(1.6F);
  EXPECT_NE(first, later);
  EXPECT_EQ(picture(0.4F), first);
  EXPECT_EQ(picture(1.6F), later);
}

TEST_F(MotionGl, TheBoxOfAnObjectFollowsIt) {
  scene::SceneData scene = scene::buildScene(playing({.seed = 61}));
  FrameRenderer renderer(scene, 64, 64);
  const scene::Camera camera = scene::frameBox(scene.boundsWorld, 1.0F);
  FrameOptions options;
  for (const float seconds : {0.2F, 1.5F}) {
    options.seconds = seconds;
    renderer.render(options, camera, camera);
    scene::SceneData posed = scene;
    scene::poseScene(posed, seconds);
    for (std::uint32_t object = 0; object < posed.objects.size(); ++object) {
      const gpu::Chain& chain = posed.chains[posed.objects[object].chain];
      const Aabb expected = transformed(scene::worldFromObject(posed.transforms[posed.objects[object].transform]),
                                        {glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)});
      EXPECT_LT(glm::distance(renderer.readBounds(object).center(), expected.center()), 1e-3F) << object;
    }
  }
}

}  // namespace
}  // namespace jalousie::render
