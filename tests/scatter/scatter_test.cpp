// Reads the scattered scene back with the scene reader: instances, chain, camera, occluder, presets.
#include "scatter/scatter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asset/instancing.h"
#include "asset/lod_chain.h"
#include "asset/scene_file.h"
#include "scatter/camera_path.h"
#include "scatter/command_line.h"
#include "scatter/scatter_fixtures.h"

namespace jalousie::scatter {
namespace {

Options parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), {"jalousie-scatter", "in.glb", "-o", "out.glb"});
  return *parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

std::optional<ErrorCode> parseCode(std::vector<const char*> arguments) {
  return test::codeOf([&] { parse(std::move(arguments)); });
}

ScatteredScene scatter(const Options& options, tinygltf::Model model = test::bakedBall()) {
  Progress progress("test", 0, true);
  return scatterObjects(std::move(model), options, progress);
}

asset::SceneFile readBack(const ScatteredScene& scene) {
  const test::TempFolder folder;
  asset::saveGlb(scene.model, folder / "scene.glb");
  return asset::readSceneFile(folder / "scene.glb");
}

TEST(Scatter, SameOptionsSameBytesOtherSeedOtherBytes) {
  const Options options = parse({"--count", "100", "--rotate", "any", "--occluder", "foliage"});
  const std::vector<std::byte> first = asset::encodeGlb(scatter(options).model);
  EXPECT_EQ(asset::encodeGlb(scatter(options).model), first);
  const Options other = parse({"--count", "100", "--rotate", "any", "--occluder", "foliage", "--seed", "2"});
  EXPECT_NE(asset::encodeGlb(scatter(other).model), first);
}

TEST(Scatter, ChainAndMaterialsSurvive) {
  const ScatteredScene scene = scatter(parse({"--count", "20"}));
  EXPECT_EQ(scene.summary.levels, 3U);
  EXPECT_EQ(scene.summary.trianglesPerObject, 128U);
  EXPECT_EQ(scene.summary.trianglesFull, 20U * 128U);
  const asset::SceneFile file = readBack(scene);
  EXPECT_EQ(file.instances.size(), 20U);
  ASSERT_EQ(file.chains.size(), 1U);
  ASSERT_EQ(file.chains[0].levels.size(), 3U);
  EXPECT_FLOAT_EQ(file.chains[0].levels[2].errorObject, 0.2F);
  std::vector<std::size_t> triangles;
  for (const asset::LodLevel& level : file.chains[0].levels)
    triangles.push_back(file.meshes[level.mesh].primitives[0].indices.size() / 3);
  EXPECT_EQ(triangles, (std::vector<std::size_t>{128, 32, 8}));
  EXPECT_EQ(file.materials[file.meshes[0].primitives[0].material].name, "clay");
}

TEST(Scatter, CellsSurvive) {
  tinygltf::Model model = test::bakedBall();
  for (std::uint32_t lod = 0; lod < 3; ++lod) {
    tinygltf::Mesh& mesh = model.meshes[lod];
    const std::uint32_t triangles = 128U >> (2 * lod);
    asset::setLodInfo(mesh, {lod, triangles, 3 * triangles, 0.1 * lod, asset::LodMeasures()});
    asset::setLodCells(mesh, {{3, triangles - 3}});
  }
  const asset::SceneFile file = readBack(scatter(parse({"--count", "20"}), std::move(model)));
  for (std::uint32_t lod = 0; lod < 3; ++lod) {
    const std::vector<std::uint32_t> expected = {9, 3 * (128U >> (2 * lod))};
    EXPECT_EQ(file.meshes[file.chains.at(0).levels.at(lod).mesh].primitives[0].cellEnds, expected) << lod;
  }
}

TEST(Scatter, LevelsShareTheInstancesAndTheCoverage) {
  const tinygltf::Model model = scatter(parse({"--count", "20"})).model;
  const asset::Instances first = asset::readInstances(model, 0).values;
  for (const int node : asset::lodNodes(model, 0))
    EXPECT_EQ(asset::readInstances(model, node).values.translations, first.translations);
  EXPECT_EQ(asset::lodNodes(model, 0).size(), 2U);
  EXPECT_EQ(asset::lodCoverage(model.nodes[0]), (std::vector<float>{0.5F, 0.1F, 0.0F}));
}

TEST(Scatter, AnEmptyLastLevelSurvives) {
  tinygltf::Model source = test::bakedBall();
  const int empty = test::addNode(source, -1);
  asset::setLodChain(source, 0, std::vector<int>{1, 2, empty}, std::vector<float>{0.5F, 0.1F, 0.01F, 0.0F});
  const tinygltf::Model model = scatter(parse({"--count", "20"}), std::move(source)).model;
  EXPECT_EQ(asset::lodNodes(model, 0).size(), 2U);
  EXPECT_GE(asset::emptyLevel(model, 0), 0);
  EXPECT_EQ(asset::lodCoverage(model.nodes[0]), (std::vector<float>{0.5F, 0.1F, 0.01F, 0.0F}));
}

TEST(Scatter, BoundsHoldEveryVertex) {
  const ScatteredScene scene =
      scatter(parse({"--count", "50", "--rotate", "any", "--scale", "0.5,3", "--occluder", "fence"}));
  const asset::SceneFile file = readBack(scene);
  Aabb exact;
  for (const asset::Instance& instance : file.instances) {
    for (const glm::vec3& p : file.meshes[file.chains[instance.chain].levels[0].mesh].primitives[0].positions)
      exact.add(glm::vec3(instance.worldFromObject * glm::vec4(p, 1.0F)));
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(scene.summary.boundsWorld.min[axis], exact.min[axis] + 1e-3F);
    EXPECT_GE(scene.summary.boundsWorld.max[axis], exact.max[axis] - 1e-3F);
  }
}

TEST(Scatter, CameraIsAnimatedAndHoldsTheSceneBetweenItsPlanes) {
  const ScatteredScene scene = scatter(parse({"--count", "30"}));
  ASSERT_EQ(scene.model.animations.size(), 1U);
  EXPECT_EQ(scene.model.animations[0].name, "walkthrough");
  const asset::SceneFile file = readBack(scene);
  ASSERT_EQ(file.cameras.size(), 1U);
  const asset::Camera& camera = file.cameras[0];
  EXPECT_NEAR(camera.fovY, glm::radians(45.0F), 1e-6F);
  EXPECT_GT(camera.zNear, 0.0F);
  ASSERT_TRUE(camera.zFar.has_value());
  const float farthest = 0.5F * scene.summary.boundsWorld.diagonal() + glm::length(camera.track.translations[0]);
  EXPECT_GT(*camera.zFar, farthest);
  EXPECT_NEAR(camera.track.translationTimes.back() * 30.0F, 1799.0F, 1e-3F);
  EXPECT_EQ(camera.track.rotations.size(), camera.track.translations.size());
  EXPECT_LT(glm::distance(glm::vec3(camera.worldFromCamera[3]), camera.track.translations[0]), 1e-4F)
      << "the rest pose is the first frame";
}

TEST(Scatter, OccluderIsAnObjectOfItsOwn) {
  const ScatteredScene scene = scatter(parse({"--count", "1", "--occluder", "grid"}));
  const asset::SceneFile file = readBack(scene);
  ASSERT_EQ(file.instances.size(), 2U);
  ASSERT_EQ(file.chains.size(), 2U);
  EXPECT_EQ(file.chains[1].name, "occluder");
  EXPECT_EQ(file.chains[1].levels.size(), 1U);
  const float z = file.instances[1].worldFromObject[3].z;
  EXPECT_GT(z, 1.0F);
  EXPECT_LT(z, static_cast<float>(file.cameras.at(0).worldFromCamera[3].z));
  const asset::Material& material = file.materials[file.meshes[file.chains[1].levels[0].mesh].primitives[0].material];
  EXPECT_TRUE(material.doubleSided);
  EXPECT_EQ(material.alphaMode, asset::AlphaMode::kOpaque);
  EXPECT_EQ(scene.summary.trianglesFull, 128U + scene.summary.occluderTriangles);
}

/// Lowest vertex of an instance's LOD 0.
float lowestOf(const asset::SceneFile& file, const asset::Instance& instance) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const asset::Primitive& primitive : file.meshes[file.chains[instance.chain].levels[0].mesh].primitives)
    for (const glm::vec3& p : primitive.positions)
      lowest = std::min(lowest, (instance.worldFromObject * glm::vec4(p, 1.0F)).y);
  return lowest;
}

TEST(Scatter, ObjectsStandOnTheGround) {
  const ScatteredScene scene = scatter(parse({"--count", "40", "--layout", "ground", "--scale", "0.5,2"}));
  const asset::SceneFile file = readBack(scene);
  ASSERT_EQ(file.instances.size(), 41U);
  ASSERT_EQ(file.chains.size(), 2U);
  EXPECT_EQ(file.chains[1].name, "ground");
  Aabb ground;
  const asset::Instance& slab = file.instances[40];
  for (const glm::vec3& p : file.meshes[file.chains[slab.chain].levels[0].mesh].primitives[0].positions)
    ground.add(glm::vec3(slab.worldFromObject * glm::vec4(p, 1.0F)));
  float widest = 0.0F;
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_NEAR(lowestOf(file, file.instances[i]), ground.max.y, 1e-4F) << i;
    const glm::vec3 place(file.instances[i].worldFromObject[3]);
    for (const int axis : {0, 2}) {
      EXPECT_GT(place[axis], ground.min[axis]);
      EXPECT_LT(place[axis], ground.max[axis]);
      widest = std::max(widest, std::abs(place[axis]));
    }
  }
  EXPECT_GT(widest, 0.4F * scene.summary.side);
  EXPECT_LT(ground.min.y, ground.max.y);
  EXPECT_NEAR(scene.summary.boundsWorld.min.y, ground.min.y, 1e-4F);
  EXPECT_EQ(scene.summary.trianglesFull, 40U * 128U + 12U);
}

TEST(Scatter, OccluderDoesNotMoveTheObjects) {
  const auto translations = [](const ScatteredScene& scene) {
    return asset::readInstances(scene.model, 0).values.translations;
  };
  EXPECT_EQ(translations(scatter(parse({"--count", "9"}))),
            translations(scatter(parse({"--count", "9", "--occluder", "foliage"}))));
}

/// A ball with its chain; below it a small ball at a corner, turned and scaled; and beside it a node with two
/// instances of the small ball, a camera, a light and an animation.
tinygltf::Model toy() {
  tinygltf::Model model = test::bakedBall();
  const int small = test::addBall(model, 0);
  const int arm = test::addNode(model, -1, "arm");
  model.nodes[0].children = {arm};
  model.nodes[0].translation = {1.0, 2.0, 3.0};
  model.nodes[0].rotation = {0.5, 0.5, 0.5, 0.5};
  const int hand = test::addNode(model, small, "hand");
  model.nodes[static_cast<std::size_t>(arm)].children = {hand};
  model.nodes[static_cast<std::size_t>(hand)].scale = {0.1, 0.2, 0.3};
  model.nodes[static_cast<std::size_t>(hand)].translation = {0.0, 4.0, 0.0};
  const int wheels = test::addNode(model, small, "wheels");
  asset::Instances instances;
  instances.translations = {{0, 0, -3}, {0, 0, 6}};
  instances.rotations.assign(2, glm::quat(1, 0, 0, 0));
  instances.scales.assign(2, glm::vec3(0.5F));
  const tinygltf::Value value = asset::appendInstances(model, instances);
  model.nodes[static_cast<std::size_t>(wheels)].extensions["EXT_mesh_gpu_instancing"] = value;
  test::setScene(model, {0, wheels});
  return model;
}

TEST(Scatter, TurnedAndComposedObjectsStandOnTheGround) {
  constexpr std::size_t kObjects = 12;
  const ScatteredScene scene =
      scatter(parse({"--count", "12", "--layout", "ground", "--rotate", "any", "--scale", "0.5,2"}), toy());
  const asset::SceneFile file = readBack(scene);
  ASSERT_EQ(file.instances.size(), 4 * kObjects + 1);
  const asset::Instance& slab = file.instances.back();
  float top = -std::numeric_limits<float>::infinity();
  for (const glm::vec3& p : file.meshes[file.chains[slab.chain].levels[0].mesh].primitives[0].positions)
    top = std::max(top, (slab.worldFromObject * glm::vec4(p, 1.0F)).y);
  for (std::size_t object = 0; object < kObjects; ++object) {  // 12 balls, 12 hands, then 2 wheels for each object
    const std::size_t parts[] = {object, kObjects + object, 2 * kObjects + 2 * object, 2 * kObjects + 2 * object + 1};
    float lowest = std::numeric_limits<float>::infinity();
    for (const std::size_t part : parts)
      lowest = std::min(lowest, lowestOf(file, file.instances[part]));
    EXPECT_NEAR(lowest, top, 0.1F) << object << ", 1 % of its size";
  }
}

/// The scene's transforms of one mesh after the other, in the order of the file.
std::vector<glm::mat4> transformsOf(const asset::SceneFile& file) {
  std::vector<glm::mat4> transforms;
  for (const asset::Instance& instance : file.instances)
    transforms.push_back(instance.worldFromObject);
  return transforms;
}

TEST(Scatter, AllMeshesOfAnAssetKeepTheirPlacesInEachObject) {
  const tinygltf::Model model = toy();
  const ScatteredScene scene = scatter(parse({"--count", "5", "--rotate", "any", "--scale", "0.5,2"}), model);
  EXPECT_EQ(scene.summary.meshesPerObject, 4U);
  EXPECT_EQ(scene.summary.trianglesPerObject, 128U + 3 * 8U);
  EXPECT_EQ(scene.summary.levels, 3U);
  EXPECT_TRUE(scene.summary.ignored.empty());
  const std::vector<glm::mat4> source = transformsOf(asset::readScene(model, "toy.glb"));
  const std::vector<glm::mat4> all = transformsOf(readBack(scene));
  ASSERT_EQ(source.size(), 4U);
  ASSERT_EQ(all.size(), 20U);
  for (std::size_t object = 0; object < 5; ++object) {  // 5 balls, 5 hands, then 2 wheels for each object
    const glm::mat4 worldFromAsset = all[object] * glm::inverse(source[0]);
    const glm::mat4 others[] = {all[5 + object], all[10 + 2 * object], all[11 + 2 * object]};
    for (std::size_t part = 1; part < 4; ++part) {
      const glm::mat4 expected = worldFromAsset * source[part];
      for (int column = 0; column < 4; ++column)
        EXPECT_LT(glm::distance(expected[column], others[part - 1][column]), 1e-4F) << object << " " << part;
    }
  }
}

TEST(Scatter, TheBoxOfAnAssetIsInTheMiddleAndWithinTheBounds) {
  const ScatteredScene scene = scatter(parse({"--count", "1"}), toy());
  const asset::SceneFile file = readBack(scene);
  Aabb exact;
  for (const asset::Instance& instance : file.instances)
    for (const glm::vec3& p : file.meshes[file.chains[instance.chain].levels[0].mesh].primitives[0].positions)
      exact.add(glm::vec3(instance.worldFromObject * glm::vec4(p, 1.0F)));
  EXPECT_LT(glm::length(scene.summary.boundsWorld.center()), 1e-4F);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(scene.summary.boundsWorld.min[axis], exact.min[axis] + 1e-4F);
    EXPECT_GE(scene.summary.boundsWorld.max[axis], exact.max[axis] - 1e-4F);
  }
}

TEST(Scatter, MeshesThatNodesShareAreWrittenOnceAndChainsAreKept) {
  const tinygltf::Model model = scatter(parse({"--count", "3"}), toy()).model;
  EXPECT_EQ(model.meshes.size(), 4U) << "three levels of the ball, one small ball";
  EXPECT_EQ(model.nodes.size(), 6U) << "three levels, hand, wheels, camera";
  EXPECT_EQ(asset::lodNodes(model, 0).size(), 2U);
  EXPECT_EQ(model.nodes[3].name, "hand");
  const asset::SceneFile file = readBack(scatter(parse({"--count", "3"}), toy()));
  EXPECT_EQ(file.chains.size(), 2U);
  EXPECT_EQ(file.chains[0].coverage, (std::vector<float>{0.5F, 0.1F, 0.0F}));
}

TEST(Scatter, WhatIsLeftOutIsCounted) {
  tinygltf::Model model = scatter(parse({"--count", "4"})).model;  // with a camera and its animation
  test::addNode(model, -1, "lamp");
  model.nodes.back().extensions["KHR_lights_punctual"] = tinygltf::Value(tinygltf::Value::Object());
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()) - 1);
  const ScatteredScene twice = scatter(parse({"--count", "3"}), model);
  EXPECT_EQ(twice.summary.meshesPerObject, 4U);
  EXPECT_EQ(twice.summary.ignored, (asset::ContentCounts{{"animation channels", 2}, {"cameras", 1}, {"lights", 1}}));
  const asset::SceneFile file = readBack(twice);
  EXPECT_EQ(file.instances.size(), 12U);
  EXPECT_EQ(file.cameras.size(), 1U);
}

TEST(Scatter, OfAGroupWithLevelsTheFinestIsTaken) {
  tinygltf::Model model = toy();
  const int group = test::addNode(model, -1, "group");
  const int coarse = test::addNode(model, -1, "coarse");
  model.nodes[static_cast<std::size_t>(group)].children = {0};
  const int coarseMesh = test::addNode(model, 2);
  model.nodes[static_cast<std::size_t>(coarse)].children = {coarseMesh};
  asset::setLodChain(model, group, std::vector<int>{coarse}, std::vector<float>{0.5F, 0.0F});
  test::setScene(model, {group});
  const ScatteredScene scene = scatter(parse({"--count", "2"}), model);
  EXPECT_EQ(scene.summary.meshesPerObject, 2U);
  EXPECT_EQ(scene.summary.ignored, (asset::ContentCounts{{"groups with levels, of which LOD 0 is scattered", 1}}));
}

TEST(Scatter, PresetsAreTheThesisScenes) {
  const Options dense = parse({"--preset", "thesis-5001"});
  EXPECT_EQ(dense.layout.count, 5001U);
  EXPECT_EQ(dense.layout.rotation, Rotation::kX);
  EXPECT_EQ(dense.layout.scale.min, dense.layout.scale.max);
  const Options sparse = parse({"--preset", "thesis-10001"});
  EXPECT_EQ(sparse.layout.count, 10001U);
  EXPECT_LT(sparse.layout.scale.min, sparse.layout.scale.max);
  EXPECT_GT(sparse.layout.sideDiagonals, 2.0F * dense.layout.sideDiagonals);
  EXPECT_EQ(readBack(scatter(dense)).instances.size(), 5001U);
}

TEST(Scatter, ExplicitOptionsOverrideThePreset) {
  const Options options = parse(
      {"--preset", "thesis-10001", "--count", "7", "--side", "3", "--rotate", "none", "--scale", "2,2", "--seed", "9"});
  EXPECT_EQ(options.layout.count, 7U);
  EXPECT_EQ(options.layout.side, 3.0F);
  EXPECT_EQ(options.layout.rotation, Rotation::kNone);
  EXPECT_EQ(options.layout.scale.min, 2.0F);
  EXPECT_EQ(options.layout.seed, 9U);
}

TEST(Scatter, ContradictoryOptionsAreUsageErrors) {
  EXPECT_EQ(parseCode({"--count", "3"}), std::nullopt);
  for (const std::vector<const char*>& arguments :
       std::vector<std::vector<const char*>>{{},
                                             {"--count", "0"},
                                             {"--count", "-1"},
                                             {"--count", "x"},
                                             {"--count", "99999999"},
                                             {"--count", "4294967297"},
                                             {"--count", "3", "--side", "0"},
                                             {"--count", "3", "--side", "-2"},
                                             {"--count", "3", "--side", "nan"},
                                             {"--count", "3", "--side", "inf"},
                                             {"--count", "3", "--scale", "2,1"},
                                             {"--count", "3", "--scale", "0,1"},
                                             {"--count", "3", "--scale", "1"},
                                             {"--count", "3", "--scale", "1,x"},
                                             {"--count", "3", "--scale", "1,inf"},
                                             {"--count", "3", "--rotate", "y"},
                                             {"--count", "3", "--layout", "sphere"},
                                             {"--preset", "thesis-1"},
                                             {"--count", "3", "--occluder", "wall"},
                                             {"--count", "3", "--occluder", "grid", "--cover", "1.5"},
                                             {"--count", "3", "--cover", "0.5"},
                                             {"--count", "3", "--unknown"},
                                             {"--count", "3", "second.glb"}}) {
    std::string shown;
    for (const char* argument : arguments)
      shown += std::string(argument) + " ";
    EXPECT_EQ(parseCode(arguments), ErrorCode::kUsage) << shown;
  }
}

TEST(Scatter, LengthsBeyondFloatAreRefused) {
  EXPECT_EQ(test::codeOf([] { scatter(parse({"--count", "3", "--side", "3e38"})); }), ErrorCode::kUsage);
  EXPECT_EQ(test::codeOf([] { scatter(parse({"--count", "3", "--scale", "1,3e38"})); }), ErrorCode::kUsage);
}

}  // namespace
}  // namespace jalousie::scatter
