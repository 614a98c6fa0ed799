// Flattening of scenes into GPU-ready arrays.
#include "scene/scene_data.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numbers>

#include "asset/scene_file.h"
#include "core/error.h"
#include "core/random.h"
#include "scene/scene_memory.h"
#include "scene/texture_layers.h"
#include "support/error_code.h"
#include "support/scenes.h"

namespace jalousie::scene {
namespace {

TEST(SceneNames, AreThoseOfNodesAndMeshesWhereverTheFileHasThem) {
  SceneNames names;
  names.nodes = {"door", "", std::string(300, 'x')};
  names.nodeOf = {0, 1, 9, 2};
  names.meshes = {"panel", ""};
  EXPECT_EQ(names.nodeName(0), "door");
  EXPECT_EQ(names.nodeName(2), "") << "an index out of range";
  EXPECT_EQ(names.nodeName(4), "") << "an instance out of range";
  EXPECT_EQ(names.meshName(7), "");
  EXPECT_EQ(shownName(names, 0, 0), "door");
  EXPECT_EQ(shownName(names, 1, 0), "panel");
  EXPECT_EQ(shownName(names, 1, 1), "object 1");
  EXPECT_EQ(shownName(names, 3, 0), std::string(kLongestShownName - 3, 'x') + "...");
}

TEST(SceneNames, AreCutBetweenCharactersAndHaveNoControlCharacters) {
  SceneNames names;
  std::string umlauts;
  for (int i = 0; i < 100; ++i)
    umlauts += "\xC3\xA4";
  names.nodes = {umlauts, "a\nb\x1B[0m\x7F", std::string(200, '\x80')};
  names.nodeOf = {0, 1, 2};
  const std::string cut = shownName(names, 0, 0);
  EXPECT_LE(cut.size(), kLongestShownName);
  EXPECT_EQ(cut.size() % 2, 1U) << "whole characters of two bytes, and three dots";
  EXPECT_EQ(shownName(names, 1, 0), "a b [0m ");
  EXPECT_EQ(shownName(names, 2, 0), "...") << "bytes that are no characters";
}

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

TEST(SceneData, MeanErrorsAscendAndFallBackOnTheLargest) {
  constexpr float kUnknown = std::numeric_limits<float>::infinity();
  asset::SceneFile file = test::sphereChain(5);
  std::vector<asset::LodLevel>& levels = file.chains[0].levels;
  const float largest[] = {0.0F, 1.0F, 2.0F, kUnknown, 5.0F};
  for (std::size_t k = 0; k < 5; ++k)
    levels[k].errorObject = largest[k];
  levels[1].meanErrorObject = 0.5F;
  levels[2].meanErrorObject = 0.25F;
  const auto means = [&] {
    const SceneData scene = buildScene(file, {.patches = true});
    std::vector<float> result;
    for (const gpu::Lod& lod : scene.lods)
      result.push_back(lod.meanErrorObject);
    EXPECT_EQ(result.back(), scene.lods.back().errorObject) << "the patch base";
    result.pop_back();
    return result;
  };
  EXPECT_EQ(means(), (std::vector<float>{0.0F, 0.5F, 0.5F, kUnknown, 5.0F}));
  levels[1].meanErrorObject = 3.0F;
  EXPECT_EQ(means()[1], 1.0F) << "never above the largest";
}

TEST(SceneData, TheSurfaceIsThatOfTheFinestLevel) {
  const SceneData scene = buildScene(test::sphereChain(4));
  EXPECT_NEAR(scene.chains[0].surfaceObject, 4.0F * std::numbers::pi_v<float>, 0.05F);
}

TEST(SceneData, TransformsAreKept) {
  asset::SceneFile file = test::sphereChain(1);
  test::addInstance(file, 0, {1, 2, 3}, {1, 1, 1});
  test::addInstance(file, 0, {4, 5, 6}, {-2, 1, 1}, 0.5F);
  const SceneData scene = buildScene(file);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(worldFromObject(scene.transforms[i]), file.instances[i].worldFromObject);
}

TEST(SceneData, SegmentsComeBeforePointsInWorldSpace) {
  asset::SceneFile file;
  file.materials.emplace_back();
  const asset::LooseVertex corner{{1, 0, 0}, {0, 0, 0}, {0, 0}, glm::vec4(1), 0};
  asset::LooseVertex lit = corner;
  lit.normal = {1, 0, 0};
  file.looseGeometries = {{{corner}, {corner, lit}}};
  glm::mat4 moved(1.0F);
  moved[0] = {0, 3, 0, 0};  // a quarter turn
  moved[1] = {-3, 0, 0, 0};
  moved[3] = {0, 0, 7, 1};
  file.looseInstances = {{0, glm::mat4(1.0F), std::nullopt}, {0, moved, 4}};
  const SceneData scene = buildScene(file);
  ASSERT_EQ(scene.loose.vertices.size(), 6U);
  EXPECT_EQ(scene.loose.lineVertices, 4U);
  EXPECT_EQ(scene.loose.vertices[0].position, glm::vec3(1, 0, 0));
  EXPECT_EQ(scene.loose.vertices[0].normal, 0U);
  EXPECT_EQ(scene.loose.vertices[3].position, glm::vec3(0, 3, 7));
  EXPECT_EQ(scene.loose.vertices[3].normal, packNormal({0, 1, 0}));
  EXPECT_EQ(scene.loose.vertices[5].position, glm::vec3(0, 3, 7));
  EXPECT_EQ(scene.boundsWorld.max, glm::vec3(1, 3, 7));
  const SceneData without = buildScene(file, {.hidden = {4}});
  EXPECT_EQ(without.loose.vertices.size(), 3U) << "the points and lines of a hidden instance are hidden";
  EXPECT_EQ(without.boundsWorld.max, scene.boundsWorld.max);
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

TEST(TextureLayers, LargeImagesKeepTheirSize) {
  const TextureLayout layout = layoutTextures(std::vector<asset::ImageSize>{{4096, 2048}, {1, 1}});
  const TextureClass& large = layout.classes.at(layout.slots.at(0).textureClass);
  EXPECT_EQ(large.width, 4096U);
  EXPECT_EQ(large.height, 2048U);
}

TEST(TextureLayers, AreThePowersOfTwoThatHoldEachImage) {
  const ImageRgba8 small{3, 5, std::vector<std::uint8_t>(60, 100)};
  const ImageRgba8 wide{20, 2, std::vector<std::uint8_t>(160, 200)};
  const TextureLayers textures = makeTextureLayers({small, wide});
  ASSERT_EQ(textures.layout.classes.size(), 2U);
  const std::vector<ImageRgba8> narrow = makeLayer(textures, 0);
  EXPECT_EQ(narrow[0].width, 4U);
  EXPECT_EQ(narrow[0].height, 8U);
  const std::vector<ImageRgba8> flat = makeLayer(textures, 1);
  ASSERT_EQ(flat.size(), 6U) << "32x2, 16x1, 8x1, 4x1, 2x1, 1x1";
  EXPECT_EQ(flat[1].width, 16U);
  EXPECT_EQ(flat[1].height, 1U);
  EXPECT_EQ(flat[5].pixels.size(), 4U);
  EXPECT_NEAR(flat[0].pixels[100], 200, 1);
  EXPECT_NEAR(flat[5].pixels[0], 200, 1);
  const TextureLayers limited = makeTextureLayers({small, wide}, {}, 16);
  EXPECT_EQ(makeLayer(limited, 1)[0].width, 16U);
}

/// Texels of the layers, and those that the images need at the powers of two above their sides.
struct Texels {
  std::uint64_t laidOut = 0;
  std::uint64_t needed = 0;
};

Texels checkLayout(const std::vector<asset::ImageSize>& sizes) {
  const TextureLayout layout = layoutTextures(sizes);
  EXPECT_LE(layout.classes.size(), gpu::kTextureClasses);
  std::vector<std::vector<bool>> taken;
  Texels texels;
  for (const TextureClass& size : layout.classes) {
    taken.emplace_back(size.layers, false);
    texels.laidOut += size.texels();
  }
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const TextureSlot slot = layout.slots[i];
    const TextureClass& size = layout.classes.at(slot.textureClass);
    EXPECT_GE(size.width, sizes[i].width);
    EXPECT_GE(size.height, sizes[i].height);
    EXPECT_FALSE(taken[slot.textureClass].at(slot.layer)) << "two images share a layer";
    taken[slot.textureClass][slot.layer] = true;
    texels.needed += std::uint64_t{std::bit_ceil(sizes[i].width)} * std::bit_ceil(sizes[i].height);
  }
  return texels;
}

TEST(TextureLayers, EveryImageHasALayerThatHoldsItAndTexelsAreBounded) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    std::vector<asset::ImageSize> sizes(1 + random.below(150));
    for (asset::ImageSize& size : sizes) {
      const std::uint32_t longest = 1U << random.below(11);
      size = {1 + random.below(longest), 1 + random.below(longest)};
    }
    const Texels texels = checkLayout(sizes);
    EXPECT_LE(texels.laidOut, 2 * texels.needed) << "seed " << seed;
  }
}

TEST(TextureLayers, OneLargeImageDoesNotEnlargeTheOthers) {
  std::vector<asset::ImageSize> sizes(200, {2, 2});
  sizes[7] = {1024, 1024};
  const Texels texels = checkLayout(sizes);
  EXPECT_LE(4 * texels.laidOut, 5 * texels.needed);
  EXPECT_EQ(layoutTextures(sizes).classes.size(), 2U);
}

TEST(TextureLayers, ImagesOfOneSizeAreOneClass) {
  EXPECT_EQ(layoutTextures(std::vector<asset::ImageSize>(90, {512, 512})).classes.size(), 1U);
}

TEST(SceneMemory, EstimatesAreTheBytesOfTheBuiltScene) {
  const asset::SceneFile file = test::randomSpheres(3000, 10.0F, 5);
  const SceneData scene = buildScene(file);
  const double bytes = static_cast<double>(
      sizeof(Vertex) * scene.vertices.capacity() + sizeof(std::uint32_t) * scene.indices.capacity() +
      sizeof(gpu::Transform) * scene.transforms.capacity() + sizeof(gpu::Object) * scene.objects.capacity() +
      sizeof(gpu::Tile) * scene.binLayout.tiles.capacity() + sizeof(gpu::Bin) * scene.binLayout.bins.capacity());
  const double estimate = static_cast<double>(sceneNeeds(sizeOf(scene), false).bytes());
  EXPECT_GE(estimate, bytes);
  EXPECT_LE(estimate, 1.4 * bytes) << "counts a tile per object and the order that sorting takes";
}

TEST(TextureLayers, MaskedMipLevelsKeepTheirCoverage) {
  // Scattered thin leaves: plain averaging loses them all within two levels.
  ImageRgba8 blades{64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 0)};
  Random random(8);
  for (std::size_t texel = 0; texel < blades.pixels.size(); texel += 4) {
    const float alpha = std::max(0.0F, random.uniform() - 0.7F) / 0.3F;
    blades.pixels[texel + 1] = alpha > 0.0F ? 180 : 0;
    blades.pixels[texel + 3] = static_cast<std::uint8_t>(255.0F * alpha);
  }
  const float coverage = alphaCoverage(blades, 0.5F);
  EXPECT_NEAR(coverage, 0.15F, 0.02F);
  const auto kept = makeMipLevels(blades, 0.5F);
  const auto plain = makeMipLevels(blades, std::nullopt);
  ASSERT_EQ(kept.size(), 7U);
  for (std::size_t level = 1; level <= 3; ++level)
    EXPECT_NEAR(alphaCoverage(kept[level], 0.5F), coverage, 0.05F) << "level " << level;
  EXPECT_EQ(alphaCoverage(plain[2], 0.5F), 0.0F);
  EXPECT_NEAR(kept[2].pixels[1], 180, 2) << "colour under holes does not bleed in";
}

TEST(TextureLayers, MipLevelsAverageInLinearLight) {
  ImageRgba8 checker{2, 2, {255, 255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255}};
  EXPECT_NEAR(makeMipLevels(checker, std::nullopt)[1].pixels[0], 188, 1);
}

TEST(BinLayout, HoldsMoreEntriesThanOneRoundOfSumsAndRefusesMoreThan32Bits) {
  constexpr gpu::uint kChains = 60000;
  std::vector<gpu::Chain> chains(kChains);
  std::vector<gpu::Object> objects;
  for (gpu::uint c = 0; c < kChains; ++c) {
    chains[c].lodCount = 10;
    objects.push_back({c, c, c, 0});
  }
  std::vector<gpu::Lod> levels(10);
  for (gpu::Lod& level : levels)
    level.triangleCount = 1;
  const BinLayout layout = layoutBins(chains, objects, levels, false);
  EXPECT_EQ(layout.entryCount, 20 * kChains + 1);
  EXPECT_EQ(layout.bins.size(), 20U * kChains);
  EXPECT_EQ(chains.back().firstEntry, 20 * (kChains - 1));

  std::vector<gpu::Chain> huge(1);
  huge[0].lodCount = 1U << 30U;
  const std::vector<gpu::Object> twoTiles(gpu::kObjectGroupSize + 1);
  EXPECT_EQ(test::codeOf([&] { layoutBins(huge, twoTiles, {}, false); }), ErrorCode::kLimit);
}

TEST(SceneData, ObjectsAreSortedByChainAndCutIntoTiles) {
  asset::SceneFile file = test::sphereChain(3);
  file.chains.push_back({"unused", file.chains[0].levels});
  file.chains.push_back({"other", {file.chains[0].levels[0]}});
  for (std::uint32_t i = 0; i < 200; ++i)
    test::addInstance(file, i % 3 == 0 ? 2 : 0, {static_cast<float>(i), 0, 0}, glm::vec3(1));
  const SceneData scene = buildScene(file);
  ASSERT_EQ(scene.objects.size(), 200U);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const gpu::Object& object = scene.objects[i];
    EXPECT_EQ(object.chain, file.instances[object.owner].chain);
    EXPECT_EQ(worldFromObject(scene.transforms[object.transform]), file.instances[object.owner].worldFromObject);
    if (i == 0) continue;
    const gpu::Object& last = scene.objects[i - 1];
    EXPECT_TRUE(last.chain < object.chain || (last.chain == object.chain && last.owner < object.owner));
  }
  gpu::uint next = 0;
  for (const gpu::Tile& tile : scene.binLayout.tiles) {
    EXPECT_EQ(tile.firstObject, next);
    next += tile.objectCount;
    for (gpu::uint k = tile.firstObject; k < next; ++k)
      EXPECT_EQ(scene.objects[k].chain, tile.chain);
  }
  EXPECT_EQ(next, 200U);
  EXPECT_EQ(scene.binLayout.bins.size(), 2U * 3 + 2U * 1) << "plain and mirrored per level, nothing for the unused";
  EXPECT_EQ(scene.binLayout.entryCount, 6U * 3 + 2U * 2 + 1);  // 133 objects: 3 tiles, 67: 2 tiles
}

TEST(SceneData, PatchBaseCarriesItsDistanceFromTheCurvedSurface) {
  asset::SceneFile file = test::sphereChain(1);
  file.meshes[0].primitives = {test::sphere(16, 8)};
  test::addInstance(file, 0, {0, 0, 0}, glm::vec3(1));
  const SceneData scene = buildScene(file, {.patches = true});
  const float error = scene.lods[scene.chains[0].patchLod].errorObject;
  EXPECT_GT(error, 0.01F);
  EXPECT_LT(error, 0.2F);
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
