// Flattening of scenes into GPU-ready arrays.
#include "scene/scene_data.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/error.h"
#include "scene/texture_layers.h"
#include "support/scenes.h"

namespace jalousie::scene {
namespace {

asset::SceneFile twoMaterials() {
  asset::SceneFile file = test::sphereChain(3);
  file.materials.push_back({});
  file.materials.back().alphaMode = asset::AlphaMode::kMask;
  // The sheet comes first in the file and must come last in the index buffer.
  file.meshes.push_back({"mixed", {test::box(glm::vec3(2), 1), test::sphere(8, 4, 0)}});
  file.chains.push_back({"mixed", {{3, 0.0F}}});
  return file;
}

TEST(SceneData, LevelsAreRangesWithSolidTrianglesFirst) {
  asset::SceneFile file = twoMaterials();
  test::addInstance(file, 1, {0, 0, 0}, glm::vec3(1));
  const SceneData scene = buildScene(file);
  ASSERT_EQ(scene.chains.size(), 2U);
  EXPECT_EQ(scene.chains[0].lodCount, 3U);
  const gpu::Lod& mixed = scene.lods[scene.chains[1].firstLod];
  EXPECT_EQ(mixed.solidCount, 3U * 2 * 8 * 3);
  EXPECT_EQ(mixed.sheetCount, 36U);
  EXPECT_EQ(mixed.triangleCount, 48U + 12U);
  EXPECT_TRUE(scene.usesSheets);
  for (gpu::uint i = 0; i < mixed.solidCount + mixed.sheetCount; ++i) {
    const std::size_t vertex = static_cast<std::size_t>(mixed.baseVertex) + scene.indices[mixed.firstIndex + i];
    ASSERT_LT(vertex, scene.vertices.size());
    EXPECT_EQ(scene.vertices[vertex].material, i < mixed.solidCount ? 0U : 1U);
  }
}

TEST(SceneData, ErrorsAndBoundsFollowTheChain) {
  const SceneData scene = buildScene(test::sphereChain(4));
  const gpu::Chain& chain = scene.chains[0];
  for (gpu::uint k = 1; k < chain.lodCount; ++k)
    EXPECT_GT(scene.lods[chain.firstLod + k].errorObject, scene.lods[chain.firstLod + k - 1].errorObject);
  EXPECT_NEAR(chain.boundsMaxObject.y, 1.0F, 1e-6F);
  EXPECT_NEAR(chain.boundsMinObject.y, -1.0F, 1e-6F);
}

TEST(SceneData, MirroredObjectsAreMarkedAndTransformsKept) {
  asset::SceneFile file = test::sphereChain(1);
  test::addInstance(file, 0, {1, 2, 3}, {1, 1, 1});
  test::addInstance(file, 0, {4, 5, 6}, {-2, 1, 1}, 0.5F);
  const SceneData scene = buildScene(file);
  EXPECT_EQ(scene.objects[0].flags, 0U);
  EXPECT_EQ(scene.objects[1].flags, gpu::kObjectMirrored);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(worldFromObject(scene.objects[i]), file.instances[i].worldFromObject);
  EXPECT_TRUE(scene.usesSheets);
}

TEST(SceneData, PatchBaseIsTheCoarsestLevelInsideWiderBounds) {
  const asset::SceneFile file = test::sphereChain(5);
  const SceneData plain = buildScene(file);
  const SceneData patched = buildScene(file, {.patches = true});
  const gpu::Lod& base = patched.lods[patched.chains[0].patchLod];
  EXPECT_EQ(base.triangleCount, plain.lods[plain.chains[0].patchLod].triangleCount);
  EXPECT_NE(base.baseVertex, patched.lods[patched.chains[0].patchLod - 1].baseVertex);
  EXPECT_LE(patched.chains[0].boundsMinObject.x, plain.chains[0].boundsMinObject.x);
}

TEST(SceneData, EmptySceneAndTooLongChains) {
  const SceneData empty = buildScene(test::sphereChain(1));
  EXPECT_TRUE(empty.objects.empty());
  EXPECT_TRUE(empty.boundsWorld.empty());
  asset::SceneFile file = test::sphereChain(1);
  file.chains[0].levels.resize(gpu::kMaxLods + 1);
  try {
    buildScene(file);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUnsupported);
  }
}

TEST(SceneData, NormalsPackIntoTenBitsASide) {
  EXPECT_EQ(packNormal({1, 0, 0}), 0x1ffU);
  EXPECT_EQ(packNormal({0, -1, 0}), 0x201U << 10);
  EXPECT_EQ(packNormal({0, 0, 1}), 0x1ffU << 20);
}

TEST(TextureLayers, TakeTheSmallestPowerOfTwoThatHoldsAll) {
  const ImageRgba8 small{3, 5, std::vector<std::uint8_t>(60, 100)};
  const ImageRgba8 wide{20, 2, std::vector<std::uint8_t>(160, 200)};
  const TextureLayers layers = makeTextureLayers({small, wide});
  EXPECT_EQ(layers.side, 32U);
  ASSERT_EQ(layers.layers.size(), 2U);
  for (const ImageRgba8& layer : layers.layers)
    EXPECT_EQ(layer.pixels.size(), 32U * 32 * 4);
  EXPECT_NEAR(layers.layers[1].pixels[500], 200, 1);
  EXPECT_EQ(makeTextureLayers({small, wide}, 16).side, 16U);
}

TEST(SceneData, RealScenesFlattenCompletely) {
  const char* folder = std::getenv("JALOUSIE_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "JALOUSIE_SCENES names no folder with the two game scenes";
  struct Expected {
    const char* name;
    std::size_t objects;
    std::uint64_t triangles;
  };
  for (const Expected& expected : {Expected{"cornfield_crossing", 486, 330694}, {"candela_city", 807, 444660}}) {
    const SceneData scene =
        buildScene(asset::readSceneFile(std::filesystem::path(folder) / expected.name / "scene.gltf"));
    EXPECT_EQ(scene.objects.size(), expected.objects);
    std::uint64_t triangles = 0;
    for (const gpu::Object& object : scene.objects)
      triangles += scene.lods[scene.chains[object.chain].firstLod].triangleCount;
    EXPECT_EQ(triangles, expected.triangles);
  }
}

}  // namespace
}  // namespace jalousie::scene
