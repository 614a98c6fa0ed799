// Flattening: chains, instances, geometry conversion, materials, cameras and their tracks.
#include "asset/scene_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "asset/asset_fixtures.h"
#include "asset/image_io.h"
#include "asset/instancing.h"
#include "asset/lod_chain.h"
#include "asset/scene_size.h"

namespace jalousie::asset {
namespace {

using test::addNode;
using test::addTriangle;

SceneFile flatten(const tinygltf::Model& model) {
  const test::TempFolder folder;
  saveGlb(model, folder / "scene.glb");
  return readSceneFile(folder / "scene.glb");
}

/// Replaces the first mesh's primitive by positions alone, in the given mode.
void setPositions(tinygltf::Model& model, int mode, const std::vector<glm::vec3>& positions) {
  tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
  primitive.attributes = {{"POSITION", appendVec3(model, positions, TINYGLTF_TARGET_ARRAY_BUFFER)}};
  primitive.indices = -1;
  primitive.mode = mode;
}

tinygltf::Model oneTriangle() {
  tinygltf::Model model;
  addNode(model, addTriangle(model), "thing");
  test::setScene(model, {0});
  return model;
}

TEST(SceneFile, HierarchyMultipliesTransforms) {
  tinygltf::Model model = oneTriangle();
  addNode(model, 0, "child");
  model.nodes[0].children = {1};
  model.nodes[0].translation = {10, 0, 0};
  model.nodes[0].scale = {2, 2, -2};
  model.nodes[1].translation = {1, 2, 3};
  const SceneFile scene = flatten(model);
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_EQ(scene.chains.size(), 1U) << "nodes with the same mesh share a chain";
  EXPECT_EQ(glm::vec3(scene.instances[1].worldFromObject[3]), glm::vec3(12, 4, -6));
  EXPECT_LT(glm::determinant(glm::mat3(scene.instances[0].worldFromObject)), 0.0F) << "a mirror stays in the matrix";
}

TEST(SceneFile, MatrixNodesAreColumnMajor) {
  tinygltf::Model model = oneTriangle();
  model.nodes[0].matrix = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  const glm::mat4 world = flatten(model).instances.at(0).worldFromObject;
  EXPECT_EQ(glm::vec3(world * glm::vec4(1, 0, 0, 1)), glm::vec3(5, 7, 7));
}

TEST(SceneFile, LevelsAreNoInstances) {
  for (const bool withScene : {true, false}) {
    tinygltf::Model model = oneTriangle();
    for (std::uint32_t lod = 1; lod < 3; ++lod) {
      const int mesh = addTriangle(model, glm::vec3(0.0F, 0.0F, static_cast<float>(lod)));
      LodInfo info{lod, 1, 3, 0.5 * lod};
      if (lod == 1) info.measures.emplace().twoSided = {0.5, 0.2};
      setLodInfo(model.meshes[static_cast<std::size_t>(mesh)], info);
      addNode(model, mesh);
    }
    setLodChain(model, 0, std::vector<int>{1, 2}, std::vector<float>{0.5F, 0.2F, 0.0F});
    if (!withScene) {
      model.scenes.clear();
      model.defaultScene = -1;
    }
    const SceneFile scene = flatten(model);
    EXPECT_EQ(scene.instances.size(), 1U);
    ASSERT_EQ(scene.chains.size(), 1U);
    EXPECT_EQ(scene.chains[0].name, "thing");
    ASSERT_EQ(scene.chains[0].levels.size(), 3U);
    EXPECT_FLOAT_EQ(scene.chains[0].levels[2].errorObject, 1.0F);
    EXPECT_EQ(scene.chains[0].levels[1].meanErrorObject, std::optional(0.2F));
    EXPECT_EQ(scene.chains[0].levels[2].meanErrorObject, std::nullopt) << "a file of format 1";
    EXPECT_EQ(scene.meshes.size(), 3U);
  }
}

TEST(SceneFile, NodesWithOtherThresholdsHaveOtherChains) {
  tinygltf::Model model = oneTriangle();
  const int mesh = addTriangle(model);
  for (int level = 0; level < 3; ++level)
    addNode(model, mesh);  // nodes 1 to 3
  for (int finest = 0; finest < 3; ++finest)
    addNode(model, 0);  // nodes 4 to 6
  setLodChain(model, 4, std::vector<int>{1}, std::vector<float>{0.5F, 0.0F});
  setLodChain(model, 5, std::vector<int>{2}, std::vector<float>{0.2F, 0.0F});
  setLodChain(model, 6, std::vector<int>{3}, std::vector<float>{0.5F, 0.0F});
  test::setScene(model, {4, 5, 6});
  const SceneFile scene = flatten(model);
  ASSERT_EQ(scene.chains.size(), 2U);
  EXPECT_EQ(scene.chains[0].coverage, (std::vector<float>{0.5F, 0.0F}));
  EXPECT_EQ(scene.chains[1].coverage, (std::vector<float>{0.2F, 0.0F}));
  EXPECT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(measureScene(model).chains, 2U);
  EXPECT_EQ(scene.instances[2].chain, 0U);
}

TEST(SceneFile, InstancingIsExpandedInOrder) {
  tinygltf::Model model = oneTriangle();
  Instances instances;
  instances.translations = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  instances.rotations.assign(3, glm::angleAxis(glm::radians(90.0F), glm::vec3(1, 0, 0)));
  instances.scales.assign(3, glm::vec3(2.0F));
  model.nodes[0].extensions["EXT_mesh_gpu_instancing"] = appendInstances(model, instances);
  model.nodes[0].translation = {0, 10, 0};
  const SceneFile scene = flatten(model);
  ASSERT_EQ(scene.instances.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const glm::mat4& world = scene.instances[static_cast<std::size_t>(i)].worldFromObject;
    EXPECT_EQ(glm::vec3(world[3]), glm::vec3(i + 1, 10, 0));
    const glm::vec3 up = glm::mat3(world) * glm::vec3(0, 1, 0);
    EXPECT_NEAR(up.z, 2.0F, 1e-5F);
  }
}

TEST(SceneFile, OtherScenesAreNotRead) {
  tinygltf::Model model = oneTriangle();
  addNode(model, 0);
  tinygltf::Scene second;
  second.nodes = {1};
  model.scenes.push_back(second);
  model.nodes[1].translation = {5, 0, 0};
  EXPECT_EQ(flatten(model).instances.size(), 1U);
  EXPECT_EQ(flatten(model).instances[0].worldFromObject[3].x, 0.0F);
  model.defaultScene = 1;
  EXPECT_EQ(flatten(model).instances.size(), 1U);
  EXPECT_EQ(flatten(model).instances[0].worldFromObject[3].x, 5.0F) << "the scene that the document names";
}

TEST(SceneFile, AListedChildOfAListedNodeIsDrawnOnceBelowItsParent) {
  tinygltf::Model model = oneTriangle();
  model.nodes[0].translation = {1, 0, 0};
  model.nodes.emplace_back();
  model.nodes[1].children = {0};
  model.nodes[1].translation = {0, 10, 0};
  for (const std::vector<int>& listed : {std::vector{1, 0}, std::vector{0, 1}}) {
    test::setScene(model, listed);
    const SceneFile scene = flatten(model);
    ASSERT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(glm::vec3(scene.instances[0].worldFromObject[3]), glm::vec3(1, 10, 0));
  }
}

TEST(SceneFile, LightsThatAFileRequiresAreCountedAndItsMeshesDrawn) {
  tinygltf::Model model = oneTriangle();
  model.nodes[0].extensions["KHR_lights_punctual"] =
      tinygltf::Value(tinygltf::Value::Object{{"light", tinygltf::Value(0)}});
  model.extensionsUsed = {"KHR_lights_punctual"};
  model.extensionsRequired = {"KHR_lights_punctual"};
  model.extensions["KHR_lights_punctual"] = tinygltf::Value(tinygltf::Value::Object{
      {"lights", tinygltf::Value(tinygltf::Value::Array{
                     tinygltf::Value(tinygltf::Value::Object{{"type", tinygltf::Value(std::string("point"))}})})}});
  const SceneFile scene = flatten(model);
  EXPECT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(scene.ignored, (ContentCounts{{"lights", 1}}));
}

TEST(SceneFile, NegativeScalesOfInstancesMirror) {
  tinygltf::Model model = oneTriangle();
  const glm::quat unturned(1, 0, 0, 0);
  const Instances instances{
      std::vector(3, glm::vec3(0)), std::vector(3, unturned), {{-1, 1, 1}, {1, -1, 1}, {-1, -1, -1}}};
  model.nodes[0].extensions["EXT_mesh_gpu_instancing"] = appendInstances(model, instances);
  const SceneFile scene = flatten(model);
  ASSERT_EQ(scene.instances.size(), 3U);
  for (const Instance& instance : scene.instances)
    EXPECT_LT(glm::determinant(glm::mat3(instance.worldFromObject)), 0.0F);
}

TEST(SceneFile, MissingNormalsBecomeFlat) {
  tinygltf::Model model = oneTriangle();
  setPositions(model, TINYGLTF_MODE_TRIANGLES, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const SceneFile scene = flatten(model);
  const Primitive& primitive = scene.meshes.at(0).primitives.at(0);
  EXPECT_EQ(primitive.normals, std::vector<glm::vec3>(3, glm::vec3(1, 0, 0)));
  EXPECT_EQ(primitive.uvs, std::vector<glm::vec2>(3, glm::vec2(0.0F)));
  EXPECT_EQ(primitive.colors, std::vector<glm::vec4>(3, glm::vec4(1.0F)));
  EXPECT_EQ(primitive.material, scene.materials.size() - 1);
}

TEST(SceneFile, FlatNormalsUnshareVertices) {
  tinygltf::Model model = oneTriangle();
  setPositions(model, TINYGLTF_MODE_TRIANGLES, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  model.meshes[0].primitives[0].indices = appendIndices(model, std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  const Primitive primitive = flatten(model).meshes.at(0).primitives.at(0);
  ASSERT_EQ(primitive.positions.size(), 6U);
  EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(primitive.normals[5], glm::vec3(1, 0, 0));
}

TEST(SceneFile, StripsAndFansKeepTheirFacing) {
  const std::vector<glm::vec3> strip = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
  const std::vector<glm::vec3> fan = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}};
  tinygltf::Model model = oneTriangle();
  setPositions(model, TINYGLTF_MODE_TRIANGLE_STRIP, strip);
  const Primitive stripped = flatten(model).meshes.at(0).primitives.at(0);
  setPositions(model, TINYGLTF_MODE_TRIANGLE_FAN, fan);
  const Primitive fanned = flatten(model).meshes.at(0).primitives.at(0);
  EXPECT_EQ(stripped.indices.size(), 9U);
  EXPECT_EQ(fanned.indices.size(), 9U);
  for (const glm::vec3& normal : stripped.normals)
    EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  for (const glm::vec3& normal : fanned.normals)
    EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(SceneFile, PointsAndLinesAreLooseGeometry) {
  const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  const auto loose = [&](int mode) {
    tinygltf::Model model = oneTriangle();
    setPositions(model, mode, corners);
    SceneFile scene = flatten(model);
    EXPECT_TRUE(scene.ignored.empty());
    EXPECT_TRUE(scene.instances.empty() && scene.chains.empty());
    EXPECT_EQ(scene.looseInstances.size(), 1U);
    LooseGeometry geometry = scene.looseGeometries.at(0);
    EXPECT_EQ(measureScene(model).looseInstances, 1U);
    EXPECT_GE(measureScene(model).looseVertices, geometry.points.size() + geometry.lines.size());
    return geometry;
  };
  const auto places = [](const std::vector<LooseVertex>& vertices) {
    std::vector<glm::vec3> positions(vertices.size());
    std::transform(vertices.begin(), vertices.end(), positions.begin(),
                   [](const LooseVertex& v) { return v.position; });
    return positions;
  };
  EXPECT_EQ(places(loose(TINYGLTF_MODE_POINTS).points), corners);
  const glm::vec3 a = corners[0];
  const glm::vec3 b = corners[1];
  const glm::vec3 c = corners[2];
  EXPECT_EQ(places(loose(TINYGLTF_MODE_LINE).lines), (std::vector{a, b})) << "the third end has no partner";
  EXPECT_EQ(places(loose(TINYGLTF_MODE_LINE_STRIP).lines), (std::vector{a, b, b, c}));
  const LooseGeometry loop = loose(TINYGLTF_MODE_LINE_LOOP);
  EXPECT_EQ(places(loop.lines), (std::vector{a, b, b, c, c, a}));
  EXPECT_TRUE(loop.points.empty());
  EXPECT_EQ(loop.lines[0].normal, glm::vec3(0)) << "not lit";
}

TEST(SceneFile, PointsBesideTrianglesFollowTheirInstances) {
  tinygltf::Model model = oneTriangle();
  addNode(model, 0, "again");
  model.nodes[1].translation = {5, 0, 0};
  test::setScene(model, {0, 1});
  tinygltf::Primitive points = model.meshes[0].primitives[0];
  points.indices = -1;
  points.mode = TINYGLTF_MODE_POINTS;
  model.meshes[0].primitives.push_back(points);
  const SceneFile scene = flatten(model);
  ASSERT_EQ(scene.instances.size(), 2U);
  ASSERT_EQ(scene.looseGeometries.size(), 1U) << "read once";
  EXPECT_EQ(scene.looseGeometries[0].points.size(), 3U);
  EXPECT_EQ(scene.looseGeometries[0].points[0].normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.meshes.at(0).primitives.size(), 1U);
  ASSERT_EQ(scene.looseInstances.size(), 2U);
  EXPECT_EQ(scene.looseInstances[1].instance, 1U);
  EXPECT_EQ(scene.looseInstances[1].worldFromObject, scene.instances[1].worldFromObject);
}

TEST(SceneFile, CopiesOfPointsAreLimitedByTheFile) {
  tinygltf::Model model = oneTriangle();
  setPositions(model, TINYGLTF_MODE_POINTS, std::vector<glm::vec3>(6));
  tinygltf::Accessor zeros;  // without data: what a small file may ask for is 2^24 vertices
  zeros.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  zeros.type = TINYGLTF_TYPE_VEC3;
  zeros.count = 3'000'000;
  model.accessors.push_back(zeros);
  model.nodes[0].extensions["EXT_mesh_gpu_instancing"] = tinygltf::Value(tinygltf::Value::Object{
      {"attributes", tinygltf::Value(tinygltf::Value::Object{
                         {"TRANSLATION", tinygltf::Value(static_cast<int>(model.accessors.size()) - 1)}})}});
  model.extensionsUsed = {"EXT_mesh_gpu_instancing"};
  EXPECT_EQ(test::codeOf([&] { flatten(model); }), ErrorCode::kLimit);
  EXPECT_EQ(measureScene(model).looseVertices, 18'000'000U) << "known before anything is allocated";
}

TEST(SceneFile, PointsFarFromTheOriginLoseNoDigit) {
  tinygltf::Model model = oneTriangle();
  setPositions(model, TINYGLTF_MODE_POINTS, {{0, 0, 0}, {1, 0, 0}});
  model.nodes[0].translation = {1e8 + 1, 0, 0};
  const SceneFile scene = flatten(model);
  EXPECT_GT(scene.originWorld.x, 1e7);
  EXPECT_EQ(double{scene.looseInstances.at(0).worldFromObject[3].x} + scene.originWorld.x, 1e8 + 1);
}

TEST(SceneFile, AttributesOfDifferentLengthAreMalformed) {
  tinygltf::Model model = oneTriangle();
  model.meshes[0].primitives[0].attributes["TEXCOORD_0"] =
      appendVec2(model, std::vector<glm::vec2>(2), TINYGLTF_TARGET_ARRAY_BUFFER);
  EXPECT_EQ(test::codeOf([&] { flatten(model); }), ErrorCode::kMalformed);
}

/// A texture with a picture of its own.
void addTexture(tinygltf::Model& model, const std::vector<std::byte>& encoded) {
  tinygltf::Image image;
  image.as_is = true;
  const auto* first = reinterpret_cast<const unsigned char*>(encoded.data());
  image.image.assign(first, first + encoded.size());
  tinygltf::Texture texture;
  texture.source = static_cast<int>(model.images.size());
  model.images.push_back(image);
  model.textures.push_back(texture);
}

TEST(SceneFile, MaterialsAndTheirImages) {
  tinygltf::Model model = oneTriangle();
  const std::vector<std::byte> png = encodePng({1, 1, {10, 20, 30, 255}});
  for (int i = 0; i < 2; ++i) {
    addTexture(model, png);
  }
  tinygltf::Material material;
  material.alphaMode = "MASK";
  material.alphaCutoff = 0.3;
  material.doubleSided = true;
  material.pbrMetallicRoughness.baseColorFactor = {0.5, 0.25, 0.125, 0.75};
  material.pbrMetallicRoughness.baseColorTexture.index = 1;
  model.materials.push_back(material);
  model.meshes[0].primitives[0].material = 0;
  const SceneFile scene = flatten(model);
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(0.5F, 0.25F, 0.125F, 0.75F));
  EXPECT_EQ(scene.materials[0].alphaMode, AlphaMode::kMask);
  EXPECT_FLOAT_EQ(scene.materials[0].alphaCutoff, 0.3F);
  EXPECT_TRUE(scene.materials[0].doubleSided);
  ASSERT_EQ(scene.images.size(), 1U) << "only images that a base colour uses";
  ASSERT_TRUE(scene.materials[0].baseTexture.has_value());
  EXPECT_EQ(scene.images[scene.materials[0].baseTexture->image].pixels, (std::vector<std::uint8_t>{10, 20, 30, 255}));
  EXPECT_FALSE(scene.materials[1].baseTexture.has_value());
}

/// One triangle with a material that has three textures of one picture.
tinygltf::Model threeTextures() {
  tinygltf::Model model = oneTriangle();
  const std::vector<std::byte> png = encodePng({1, 1, {10, 20, 30, 255}});
  addTexture(model, png);
  tinygltf::Sampler sampler;
  sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  sampler.wrapT = TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_NEAREST;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST;
  model.samplers.push_back(sampler);
  model.textures[0].sampler = 0;
  tinygltf::Material material;
  material.pbrMetallicRoughness.baseColorTexture.index = 0;
  material.pbrMetallicRoughness.baseColorTexture.texCoord = 1;
  material.emissiveTexture.index = 0;
  material.emissiveFactor = {0.5, 0.25, 1.0};
  material.normalTexture.index = 0;
  material.normalTexture.scale = 0.5;
  model.materials.push_back(material);
  model.meshes[0].primitives[0].material = 0;
  return model;
}

tinygltf::Value object(std::initializer_list<std::pair<const std::string, tinygltf::Value>> members) {
  return tinygltf::Value(tinygltf::Value::Object(members));
}

TEST(SceneFile, EveryMinifyingFilterIsItself) {
  struct Filter {
    int code;
    bool nearest;
    Mip mip;
  };
  for (const Filter& filter : {Filter{TINYGLTF_TEXTURE_FILTER_NEAREST, true, Mip::kNone},
                               Filter{TINYGLTF_TEXTURE_FILTER_LINEAR, false, Mip::kNone},
                               Filter{TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST, true, Mip::kNearest},
                               Filter{TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST, false, Mip::kNearest},
                               Filter{TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR, true, Mip::kLinear},
                               Filter{TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR, false, Mip::kLinear}}) {
    tinygltf::Model model = threeTextures();
    model.samplers[0].minFilter = filter.code;
    const Sampling sampling = flatten(model).materials.at(0).baseTexture.value().sampling;
    EXPECT_EQ(sampling.minifyNearest, filter.nearest) << filter.code;
    EXPECT_EQ(sampling.mip, filter.mip) << filter.code;
  }
}

TEST(SceneFile, TexturesHaveSamplersTransformsAndTexCoords) {
  tinygltf::Model model = threeTextures();
  using Array = tinygltf::Value::Array;
  model.materials[0].emissiveTexture.extensions["KHR_texture_transform"] =
      object({{"offset", tinygltf::Value(Array{tinygltf::Value(0.25), tinygltf::Value(0.5)})},
              {"rotation", tinygltf::Value(1.5707963267948966)},
              {"scale", tinygltf::Value(Array{tinygltf::Value(2), tinygltf::Value(4)})},
              {"texCoord", tinygltf::Value(1)}});
  model.materials[0].extensions["KHR_materials_emissive_strength"] =
      object({{"emissiveStrength", tinygltf::Value(3.0)}});
  const SceneFile scene = flatten(model);
  const Material& material = scene.materials[0];
  ASSERT_TRUE(material.baseTexture && material.emissiveTexture && material.normalTexture);
  EXPECT_EQ(scene.images.size(), 2U) << "normals have a picture of their own";
  EXPECT_EQ(material.baseTexture->image, material.emissiveTexture->image);
  EXPECT_NE(material.baseTexture->image, material.normalTexture->image);
  const Sampling expected = {Wrap::kClamp, Wrap::kMirror, true, true, Mip::kNearest};
  EXPECT_EQ(material.baseTexture->sampling, expected);
  EXPECT_EQ(material.baseTexture->uvSet, 1U);
  EXPECT_EQ(material.normalTexture->uvSet, 0U);
  EXPECT_EQ(material.normalScale, 0.5F);
  EXPECT_EQ(material.emission, glm::vec3(1.5F, 0.75F, 3.0F));
  const TextureUse& turned = *material.emissiveTexture;
  EXPECT_EQ(turned.uvSet, 1U);
  EXPECT_EQ(turned.uvOffset, glm::vec2(0.25F, 0.5F));
  // A quarter turn, after the scale: u becomes -v, v becomes u (specification of the extension).
  EXPECT_NEAR(glm::distance(turned.uvAxes, glm::vec4(0.0F, -2.0F, 4.0F, 0.0F)), 0.0F, 1e-6F);
  ASSERT_EQ(scene.meshes[0].primitives[0].uvs1.size(), scene.meshes[0].primitives[0].positions.size());
}

TEST(SceneFile, UnlitMaterialsHaveNoLightOfTheirOwn) {
  tinygltf::Model model = threeTextures();
  model.materials[0].extensions["KHR_materials_unlit"] = object({});
  const Material material = flatten(model).materials[0];
  EXPECT_TRUE(material.isUnlit && material.baseTexture);
  EXPECT_FALSE(material.emissiveTexture || material.normalTexture);
  EXPECT_EQ(material.emission, glm::vec3(0.0F));
}

TEST(SceneFile, BrokenExtensionsOfMaterialsAreMalformed) {
  using Array = tinygltf::Value::Array;
  const tinygltf::Value transforms[] = {
      object({{"scale", tinygltf::Value(2.0)}}), object({{"offset", tinygltf::Value(Array{tinygltf::Value(1.0)})}}),
      object({{"rotation", tinygltf::Value(std::string("left"))}}), object({{"rotation", tinygltf::Value(1e300)}})};
  for (const tinygltf::Value& transform : transforms) {
    tinygltf::Model model = threeTextures();
    model.materials[0].normalTexture.extensions["KHR_texture_transform"] = transform;
    EXPECT_EQ(test::codeOf([&] { flatten(model); }), ErrorCode::kMalformed);
  }
  tinygltf::Model model = threeTextures();
  model.materials[0].extensions["KHR_materials_emissive_strength"] =
      object({{"emissiveStrength", tinygltf::Value(-1.0)}});
  EXPECT_EQ(test::codeOf([&] { flatten(model); }), ErrorCode::kMalformed);
}

TEST(SceneFile, AllPicturesTogetherHaveALimit) {
  tinygltf::Model model = oneTriangle();
  const std::vector<std::byte> png = encodePng({4, 4, std::vector<std::uint8_t>(64, 200)});
  for (int i = 0; i < 3; ++i) {
    addTexture(model, png);
    tinygltf::Material material;
    material.pbrMetallicRoughness.baseColorTexture.index = i;
    model.materials.push_back(material);
  }
  Limits limits;
  limits.maxFileBytes = 3 * 64;
  EXPECT_EQ(readScene(model, "three.glb", limits).images.size(), 3U);
  limits.maxFileBytes = 3 * 64 - 1;
  try {
    readScene(model, "three.glb", limits);
    FAIL() << "191 bytes hold no three pictures of 64";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kLimit);
    EXPECT_NE(std::string(error.what()).find("the images are too large together"), std::string::npos) << error.what();
    EXPECT_EQ(error.file(), "three.glb");
  }
}

/// A camera on node 1 below node 0, animated with the given interpolation.
tinygltf::Model animatedCamera(const std::string& interpolation, const std::vector<glm::vec3>& outputs) {
  tinygltf::Model model = oneTriangle();
  tinygltf::Camera camera;
  camera.type = "perspective";
  camera.name = "eye";
  camera.perspective.yfov = 0.9;
  camera.perspective.znear = 0.2;
  model.cameras.push_back(camera);
  addNode(model, -1);
  model.nodes[1].camera = 0;
  model.nodes[1].translation = {0, 0, 5};
  model.nodes[0].children = {1};
  model.nodes[0].translation = {0, 10, 0};
  tinygltf::Animation animation;
  tinygltf::AnimationSampler sampler;
  sampler.input = appendScalars(model, std::vector<float>{0.0F, 1.0F}, 0);
  sampler.output = appendVec3(model, outputs, 0);
  sampler.interpolation = interpolation;
  animation.samplers.push_back(sampler);
  tinygltf::AnimationChannel channel;
  channel.sampler = 0;
  channel.target_node = 1;
  channel.target_path = "translation";
  animation.channels.push_back(channel);
  model.animations.push_back(animation);
  return model;
}

TEST(SceneFile, CameraWithLinearTrack) {
  const SceneFile scene = flatten(animatedCamera("LINEAR", {{1, 2, 3}, {4, 5, 6}}));
  ASSERT_EQ(scene.cameras.size(), 1U);
  const Camera& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "eye");
  EXPECT_FLOAT_EQ(camera.fovY, 0.9F);
  EXPECT_FLOAT_EQ(camera.zNear, 0.2F);
  EXPECT_FALSE(camera.zFar.has_value());
  EXPECT_EQ(glm::dvec3(camera.worldFromCamera[3]), glm::dvec3(0, 10, 5));
  EXPECT_EQ(glm::dvec3(camera.worldFromParent[3]), glm::dvec3(0, 10, 0));
  EXPECT_EQ(camera.track.translationTimes, (std::vector<float>{0, 1}));
  EXPECT_EQ(camera.track.translations[1], glm::vec3(4, 5, 6));
  EXPECT_TRUE(camera.track.rotations.empty());
}

TEST(SceneFile, StepTrackDoublesItsKeys) {
  const CameraTrack track = flatten(animatedCamera("STEP", {{1, 2, 3}, {4, 5, 6}})).cameras.at(0).track;
  EXPECT_EQ(track.translationTimes, (std::vector<float>{0, 1, 1}));
  EXPECT_EQ(track.translations, (std::vector<glm::vec3>{{1, 2, 3}, {1, 2, 3}, {4, 5, 6}}));
}

/// Largest distance of a camera's path from positions in the world that a function of the time gives.
float worstOf(const Camera& camera, const std::function<glm::vec3(float)>& expected) {
  const CameraTrack& track = camera.track;
  float worst = 0.0F;
  for (std::size_t i = 0; i < track.translations.size(); ++i) {
    const glm::vec3 actual(camera.worldFromParent * glm::dvec4(track.translations.get()[i], 1.0));
    worst = std::max(worst, glm::distance(actual, expected(track.translationTimes.get()[i])));
  }
  return worst;
}

TEST(SceneFile, SplineTrackFollowsItsTangents) {
  // In-tangent, value, out-tangent of two keys, a second apart; the parent stands at y = 10.
  const glm::vec3 leaving(3, -2, 1);
  const glm::vec3 arriving(-1, 4, 2);
  const std::vector<glm::vec3> outputs = {{9, 9, 9}, {1, 2, 3}, leaving, arriving, {4, 5, 6}, {9, 9, 9}};
  const Camera camera = flatten(animatedCamera("CUBICSPLINE", outputs)).cameras.at(0);
  ASSERT_EQ(camera.track.translations.size(), 31U) << "one second at 30 frames";
  const auto hermite = [&](float t) {
    return glm::vec3(0, 10, 0) + (2 * t * t * t - 3 * t * t + 1) * glm::vec3(1, 2, 3) +
           (t * t * t - 2 * t * t + t) * leaving + (3 * t * t - 2 * t * t * t) * glm::vec3(4, 5, 6) +
           (t * t * t - t * t) * arriving;
  };
  EXPECT_LT(worstOf(camera, hermite), 1e-5F);
}

TEST(SceneFile, CameraMovesWithItsParent) {
  tinygltf::Model model = animatedCamera("LINEAR", {{1, 2, 3}, {4, 5, 6}});
  model.animations[0].channels[0].target_node = 0;  // as Blender's exporter does
  model.nodes[1].rotation = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};
  const Camera camera = flatten(model).cameras.at(0);
  ASSERT_EQ(camera.track.translations.size(), 31U);
  EXPECT_LT(worstOf(camera, [](float t) { return glm::mix(glm::vec3(1, 2, 8), glm::vec3(4, 5, 11), t); }), 1e-5F);
  EXPECT_NEAR(camera.track.rotations.get()[7].y, std::sqrt(0.5F), 1e-6F);
  EXPECT_EQ(camera.track.translations.get()[0], glm::vec3(0)) << "the track starts at worldFromParent";
}

TEST(SceneFile, ChannelsThatMoveOnlyCamerasAreNotIgnored) {
  const auto ignored = [](const std::function<void(tinygltf::Model&)>& change) {
    tinygltf::Model model = animatedCamera("LINEAR", {{1, 2, 3}, {4, 5, 6}});
    model.nodes[0].mesh = -1;
    change(model);
    const ContentCounts counts = flatten(model).ignored;
    return counts.contains("animation channels") ? counts.at("animation channels") : 0;
  };
  const auto target = [](int node, const char* path) {
    return [=](tinygltf::Model& model) {
      model.animations[0].channels[0].target_node = node;
      model.animations[0].channels[0].target_path = path;
    };
  };
  for (const int node : {0, 1})
    EXPECT_EQ(ignored(target(node, "translation")), 0U) << node;
  EXPECT_EQ(ignored(target(0, "scale")), 0U) << "the camera moves";
  EXPECT_EQ(ignored(target(1, "scale")), 1U) << "a camera has no scale";
  EXPECT_EQ(ignored([&](tinygltf::Model& model) {
              target(0, "translation")(model);
              model.nodes[0].mesh = 0;
            }),
            1U)
      << "the mesh stays where it is";
  EXPECT_EQ(ignored([&](tinygltf::Model& model) {
              model.cameras[0].type = "orthographic";
              model.cameras[0].orthographic = {};
              model.cameras[0].orthographic.xmag = model.cameras[0].orthographic.ymag = 1.0;
              model.cameras[0].orthographic.zfar = 10.0;
            }),
            0U);
}

TEST(SceneFile, CamerasHaveNeitherScaleNorMirroring) {
  tinygltf::Model model = animatedCamera("LINEAR", {{1, 2, 3}, {4, 5, 6}});
  model.nodes[0].scale = {-2, 2, 2};
  const Camera camera = flatten(model).cameras.at(0);
  const glm::mat3 axes{glm::mat4(camera.worldFromCamera)};
  EXPECT_NEAR(glm::determinant(axes), 1.0F, 1e-5F);
  EXPECT_LT(glm::distance(axes[0], glm::vec3(1, 0, 0)) + glm::distance(axes[2], glm::vec3(0, 0, 1)), 1e-5F);
  EXPECT_LT(worstOf(camera, [](float t) { return glm::mix(glm::vec3(-2, 14, 6), glm::vec3(-8, 20, 12), t); }), 1e-4F);
}

/// Two triangles a unit from a place, a camera between them that moves by (1, 0, 0) in a second.
tinygltf::Model sceneAt(const std::vector<double>& place) {
  tinygltf::Model model = animatedCamera("LINEAR", {{0, 0, 0.25F}, {1, 0, 0.25F}});
  addNode(model, 0);
  model.nodes[2].translation = {0.125, 3, -1};
  model.nodes[0].children = {1, 2};
  model.nodes[0].translation = place;
  return model;
}

TEST(SceneFile, ScenesFarFromTheOriginLoseNoDigit) {
  const std::vector<double> place = {4e6 + 0.015625, -2e6 + 0.5, 1e7};
  const SceneFile near = flatten(sceneAt({0.015625, 0.5, 0}));
  EXPECT_EQ(near.originWorld, glm::dvec3(0.0));
  const SceneFile far = flatten(sceneAt(place));
  EXPECT_GT(glm::length(far.originWorld), 1e6);
  EXPECT_EQ(far.originWorld, glm::round(far.originWorld));
  const glm::dvec3 origin = far.originWorld - glm::dvec3(4e6, -2e6, 1e7);
  ASSERT_EQ(far.instances.size(), near.instances.size());
  for (std::size_t i = 0; i < far.instances.size(); ++i)
    EXPECT_EQ(glm::dvec3(far.instances[i].worldFromObject[3]) + origin,
              glm::dvec3(near.instances[i].worldFromObject[3]));
  const auto eyeAt = [](const SceneFile& scene) {
    return glm::dvec3(scene.cameras.at(0).worldFromParent *
                      glm::dvec4(scene.cameras[0].track.translations.get().back(), 1.0));
  };
  EXPECT_EQ(eyeAt(far) + origin, eyeAt(near));
  EXPECT_EQ(glm::dvec3(far.cameras[0].worldFromCamera[3]) + origin, glm::dvec3(near.cameras[0].worldFromCamera[3]));
}

TEST(SceneFile, SceneThatReachesToTheOriginStaysWhereItIs) {
  tinygltf::Model model = sceneAt({1e6, 0, 0});
  addNode(model, 0);
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()) - 1);
  EXPECT_EQ(flatten(model).originWorld, glm::dvec3(0.0));
}

TEST(SceneFile, EndlessCameraPathsAreRefused) {
  tinygltf::Model model = animatedCamera("LINEAR", {{1, 2, 3}, {4, 5, 6}});
  model.animations[0].channels[0].target_node = 0;
  model.animations[0].samplers[0].input = appendScalars(model, std::vector<float>{0.0F, 1e30F}, 0);
  EXPECT_EQ(test::codeOf([&] { flatten(model); }), ErrorCode::kLimit);
}

TEST(SceneFile, BrokenCamerasAndTracksAreMalformed) {
  const auto code = [](tinygltf::Model model) { return test::codeOf([&] { flatten(model); }); };
  EXPECT_EQ(code(animatedCamera("LINEAR", {{1, 2, 3}})), ErrorCode::kMalformed);
  tinygltf::Model model = animatedCamera("LINEAR", {{1, 2, 3}, {4, 5, 6}});
  model.cameras[0].perspective.yfov = 4.0;
  EXPECT_EQ(code(model), ErrorCode::kMalformed);
  model.cameras[0].perspective.yfov = 1.0;
  model.cameras[0].perspective.zfar = 0.1;
  EXPECT_EQ(code(model), ErrorCode::kMalformed);
  model.cameras[0].perspective.zfar = 10.0;
  EXPECT_EQ(code(model), std::nullopt);
  model.animations[0].samplers[0].input = appendScalars(model, std::vector<float>{1.0F, 1.0F}, 0);
  EXPECT_EQ(code(model), ErrorCode::kMalformed);
}

TEST(SceneFile, EmptyDocumentIsAnEmptyScene) {
  const test::TempFolder folder;
  const SceneFile scene = readSceneFile(folder.write("empty.gltf", R"({"asset": {"version": "2.0"}})"));
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_EQ(scene.materials.size(), 1U);
}

}  // namespace
}  // namespace jalousie::asset
