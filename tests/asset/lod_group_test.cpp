// Levels of groups: nodes whose levels are subtrees. Their meshes are combined into one mesh a level.
#include "asset/lod_group.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "asset/asset_fixtures.h"
#include "asset/instancing.h"
#include "asset/lod_chain.h"
#include "asset/scene_file.h"
#include "asset/scene_size.h"

namespace jalousie::asset {
namespace {

using test::addNode;
using test::addTriangle;

SceneFile flattenAt(const tinygltf::Model& model, std::optional<double> seconds = std::nullopt) {
  const test::TempFolder folder;
  saveGlb(model, folder / "scene.glb");
  return readSceneFile(folder / "scene.glb", {}, {}, {.check = {}, .seconds = seconds});
}

std::optional<ErrorCode> codeOfFlatten(const tinygltf::Model& model) {
  return test::codeOf([&] { flattenAt(model); });
}

/// A node without a mesh whose children show a mesh at x = 1 and x = 3.
int addGroup(tinygltf::Model& model, int mesh, const std::string& name) {
  const int group = addNode(model, -1, name);
  for (const double x : {1.0, 3.0}) {
    const int child = addNode(model, mesh);
    model.nodes[static_cast<std::size_t>(child)].translation = {x, 0, 0};
    model.nodes[static_cast<std::size_t>(group)].children.push_back(child);
  }
  return group;
}

void setLevels(tinygltf::Model& model, int node, const std::vector<int>& lower) {
  setLodChain(model, node, lower, std::vector<float>(lower.size() + 1, 0.0F));
}

struct GroupModel {
  tinygltf::Model model;
  int finest = 0;
  int coarse = 0;
};

/// Node `finest` with two levels of two triangles each; those of LOD 1 lie in z = 1.
GroupModel twoLevels() {
  GroupModel made;
  tinygltf::Model& model = made.model;
  const int fine = addTriangle(model);
  const int coarse = addTriangle(model, {0, 0, 1});
  made.finest = addGroup(model, fine, "finest");
  made.coarse = addGroup(model, coarse, "coarse");
  setLevels(model, made.finest, {made.coarse});
  test::setScene(model, {made.finest});
  return made;
}

const Mesh& meshOf(const SceneFile& scene, std::size_t level, std::size_t instance = 0) {
  return scene.meshes[scene.chains[scene.instances.at(instance).chain].levels.at(level).mesh];
}

tinygltf::Node& nodeOf(tinygltf::Model& model, int node) {
  return model.nodes[static_cast<std::size_t>(node)];
}

/// Adds an error, stored as format 4 stores it, to a mesh.
void storeError(tinygltf::Model& model, int mesh, double max, double mean) {
  LodInfo info{1, 1, 3, max};
  info.measures.emplace().twoSided = {max, mean};
  setLodInfo(model.meshes[static_cast<std::size_t>(mesh)], info);
}

/// Counts before reading are those of what is read.
void expectMeasured(const tinygltf::Model& model) {
  const SceneSize size = measureScene(model);
  const SceneFile scene = flattenAt(model);
  std::uint64_t vertices = 0;
  std::uint64_t indices = 0;
  std::uint64_t levels = 0;
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      vertices += primitive.positions.size();
      indices += primitive.indices.size();
    }
  }
  for (const Chain& chain : scene.chains)
    levels += chain.levels.size();
  EXPECT_EQ(size.vertices, vertices);
  EXPECT_EQ(size.indices, indices);
  EXPECT_EQ(size.chains, scene.chains.size());
  EXPECT_EQ(size.levels, levels);
  EXPECT_EQ(size.instances, scene.instances.size());
  std::uint64_t finest = 0;
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    for (const Primitive& primitive : meshOf(scene, 0, i).primitives)
      finest += primitive.indices.size() / 3;
  EXPECT_EQ(size.finestTriangles, finest);
}

TEST(LodGroup, MeshesOfALevelAreOneObject) {
  GroupModel made = twoLevels();
  nodeOf(made.model, made.finest).translation = {0, 5, 0};
  nodeOf(made.model, made.coarse).translation = {0, 5, 0};
  const SceneFile scene = flattenAt(made.model);
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(glm::vec3(scene.instances[0].worldFromObject[3]), glm::vec3(0, 5, 0));
  ASSERT_EQ(scene.chains.size(), 1U);
  EXPECT_EQ(scene.chains[0].name, "finest");
  ASSERT_EQ(scene.chains[0].levels.size(), 2U);
  for (const std::size_t level : {0U, 1U}) {
    const std::vector<Primitive>& primitives = meshOf(scene, level).primitives;
    ASSERT_EQ(primitives.size(), 2U) << level;
    const auto z = static_cast<float>(level);
    EXPECT_EQ(primitives[0].positions[0], glm::vec3(1, 0, z));
    EXPECT_EQ(primitives[1].positions[1], glm::vec3(4, 0, z));
  }
  EXPECT_EQ(scene.chains[0].levels[1].errorObject, std::numeric_limits<float>::infinity());
  EXPECT_TRUE(scene.ignored.empty());
  expectMeasured(made.model);
}

TEST(LodGroup, ALevelStandsInPlaceOfItsGroup) {
  GroupModel made = twoLevels();
  nodeOf(made.model, made.finest).scale = {2, 2, 2};
  nodeOf(made.model, made.coarse).translation = {8, 0, 0};
  const SceneFile scene = flattenAt(made.model);
  const glm::vec3 world(scene.instances.at(0).worldFromObject *
                        glm::vec4(meshOf(scene, 1).primitives[0].positions[0], 1));
  EXPECT_EQ(world, glm::vec3(9, 0, 1)) << "its own transform counts, not that of LOD 0";
}

TEST(LodGroup, MirroredPartsKeepTheirFacingAndNormals) {
  GroupModel made = twoLevels();
  nodeOf(made.model, nodeOf(made.model, made.finest).children[0]).scale = {1, 1, -1};
  nodeOf(made.model, nodeOf(made.model, made.finest).children[1]).scale = {-1, 1, 1};
  const SceneFile scene = flattenAt(made.model);
  for (const Primitive& primitive : meshOf(scene, 0).primitives) {
    const glm::vec3 a = primitive.positions[primitive.indices[0]];
    const glm::vec3 facing =
        glm::cross(primitive.positions[primitive.indices[1]] - a, primitive.positions[primitive.indices[2]] - a);
    EXPECT_GT(glm::dot(facing, primitive.normals[0]), 0.0F);
  }
  EXPECT_EQ(meshOf(scene, 0).primitives[0].normals[0], glm::vec3(0, 0, -1));
  EXPECT_EQ(meshOf(scene, 0).primitives[1].normals[0], glm::vec3(0, 0, 1));
}

TEST(LodGroup, NormalsOfUnevenScalesStayPerpendicular) {
  GroupModel made = twoLevels();
  tinygltf::Node& child = nodeOf(made.model, nodeOf(made.model, made.finest).children[0]);
  child.matrix = {1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // shears y towards z
  child.translation.clear();
  const Primitive primitive = meshOf(flattenAt(made.model), 0).primitives[0];
  const glm::vec3 edge = primitive.positions[2] - primitive.positions[0];
  EXPECT_EQ(edge, glm::vec3(0, 1, 1));
  EXPECT_NEAR(glm::dot(edge, primitive.normals[0]), 0.0F, 1e-6F);
  EXPECT_NEAR(glm::length(primitive.normals[0]), 1.0F, 1e-6F);
}

TEST(LodGroup, EqualGroupsShareAChain) {
  GroupModel made = twoLevels();
  tinygltf::Model& model = made.model;
  const int twin = addGroup(model, 0, "twin");  // with the same node as LOD 1
  setLevels(model, twin, {made.coarse});
  const int copy = addGroup(model, 0, "copy");  // with nodes of its own
  const int copyOfCoarse = addGroup(model, 1, "copy of coarse");
  setLevels(model, copy, {copyOfCoarse});
  const int other = addGroup(model, 0, "other");  // whose second part is elsewhere
  nodeOf(model, nodeOf(model, other).children[1]).translation = {3.5, 0, 0};
  setLevels(model, other, {made.coarse});
  test::setScene(model, {made.finest, twin, copy, other});
  const SceneFile scene = flattenAt(model);
  EXPECT_EQ(scene.instances.size(), 4U);
  EXPECT_EQ(scene.chains.size(), 2U);
  EXPECT_EQ(scene.meshes.size(), 3U) << "both chains have one LOD 1";
  expectMeasured(model);
}

TEST(LodGroup, StoredErrorsHoldWhereEachPartHasOne) {
  GroupModel made = twoLevels();
  storeError(made.model, 1, 0.5, 0.25);
  nodeOf(made.model, nodeOf(made.model, made.coarse).children[1]).scale = {3, 1, 1};
  const LodLevel known = flattenAt(made.model).chains.at(0).levels.at(1);
  EXPECT_GE(known.errorObject, 1.5F) << "three times as large";
  EXPECT_LT(known.errorObject, 1.6F);
  EXPECT_FLOAT_EQ(known.meanErrorObject.value_or(0.0F), known.errorObject / 2);

  GroupModel fewer = twoLevels();
  storeError(fewer.model, 1, 0.5, 0.25);
  nodeOf(fewer.model, fewer.coarse).children.pop_back();
  const LodLevel unknown = flattenAt(fewer.model).chains.at(0).levels.at(1);
  EXPECT_TRUE(std::isinf(unknown.errorObject)) << "nothing tells how far what is left out is away";
  EXPECT_EQ(unknown.meanErrorObject, std::nullopt);
}

TEST(LodGroup, MeshAndGroupMayBeLevelsOfEachOther) {
  GroupModel made = twoLevels();
  nodeOf(made.model, made.coarse).children.clear();
  nodeOf(made.model, made.coarse).mesh = 1;  // LOD 1 is one mesh
  EXPECT_EQ(meshOf(flattenAt(made.model), 1).primitives.size(), 1U);
  nodeOf(made.model, made.finest).mesh = 0;  // LOD 0 has a mesh, too: now all levels are meshes
  const SceneFile meshes = flattenAt(made.model);
  EXPECT_EQ(meshes.instances.size(), 3U) << "what is below LOD 0 is drawn at all levels";
  expectMeasured(made.model);
}

TEST(LodGroup, ALevelWithoutTrianglesEndsTheChain) {
  GroupModel made = twoLevels();
  made.model.meshes[1].primitives[0].mode = TINYGLTF_MODE_POINTS;
  const SceneFile scene = flattenAt(made.model);
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(scene.chains.at(0).levels.size(), 1U);
  nodeOf(made.model, made.coarse).children.clear();
  EXPECT_FALSE(flattenAt(made.model).instances.empty()) << "the last level shows nothing";
}

TEST(LodGroup, CamerasBelowAGroupAreRead) {
  GroupModel made = twoLevels();
  tinygltf::Camera camera;
  camera.type = "perspective";
  camera.perspective.yfov = 1.0;
  camera.perspective.znear = 0.1;
  made.model.cameras.push_back(camera);
  const int child = addNode(made.model, -1, "eye");
  nodeOf(made.model, child).camera = 0;
  nodeOf(made.model, made.finest).children.push_back(child);
  EXPECT_EQ(flattenAt(made.model).cameras.size(), 1U);
}

TEST(LodGroup, InstancesOfPartsBecomeCopies) {
  GroupModel made = twoLevels();
  Instances instances;
  instances.translations = {{0, 0, 0}, {0, 10, 0}, {0, 20, 0}};
  instances.rotations.assign(3, glm::quat(1, 0, 0, 0));
  instances.scales.assign(3, glm::vec3(1));
  nodeOf(made.model, nodeOf(made.model, made.finest).children[1]).extensions["EXT_mesh_gpu_instancing"] =
      appendInstances(made.model, instances);
  const SceneFile scene = flattenAt(made.model);
  EXPECT_EQ(scene.instances.size(), 1U);
  const std::vector<Primitive>& primitives = meshOf(scene, 0).primitives;
  ASSERT_EQ(primitives.size(), 4U);
  EXPECT_EQ(primitives[3].positions[0], glm::vec3(3, 20, 0));
  expectMeasured(made.model);
}

TEST(LodGroup, CopiesAreLimitedByTheFile) {
  GroupModel made = twoLevels();
  Instances instances;  // the triangle has 6 vertices and indices; what a small file may ask for is 2^24
  instances.translations = {{0, 0, 0}};
  instances.rotations.assign(1, glm::quat(1, 0, 0, 0));
  instances.scales.assign(1, glm::vec3(1));
  tinygltf::Node& child = nodeOf(made.model, nodeOf(made.model, made.finest).children[1]);
  tinygltf::Accessor zeros;
  zeros.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  zeros.type = TINYGLTF_TYPE_VEC3;
  zeros.count = 3'000'000;
  made.model.accessors.push_back(zeros);
  child.extensions["EXT_mesh_gpu_instancing"] = tinygltf::Value(tinygltf::Value::Object{
      {"attributes", tinygltf::Value(tinygltf::Value::Object{
                         {"TRANSLATION", tinygltf::Value(static_cast<int>(made.model.accessors.size()) - 1)}})}});
  made.model.extensionsUsed.emplace_back("EXT_mesh_gpu_instancing");
  EXPECT_EQ(codeOfFlatten(made.model), ErrorCode::kLimit);
  EXPECT_GT(measureScene(made.model).vertices, 9'000'000U) << "known before anything is allocated";
}

TEST(LodGroup, PartsFollowTheirAnimations) {
  GroupModel made = twoLevels();
  tinygltf::Model& model = made.model;
  const int twin = addGroup(model, 0, "twin");
  setLevels(model, twin, {made.coarse});
  test::setScene(model, {made.finest, twin});
  tinygltf::Animation animation;
  tinygltf::AnimationSampler sampler;
  sampler.input = appendScalars(model, std::vector<float>{0, 1}, 0);
  sampler.output = appendVec3(model, std::vector<glm::vec3>{{1, 0, 0}, {1, 4, 0}}, 0);
  animation.samplers.push_back(sampler);
  tinygltf::AnimationChannel channel;
  channel.sampler = 0;
  channel.target_node = nodeOf(model, made.finest).children[0];
  channel.target_path = "translation";
  animation.channels.push_back(channel);
  model.animations.push_back(animation);
  const SceneFile scene = flattenAt(model, 0.5);
  EXPECT_EQ(meshOf(scene, 0, 0).primitives[0].positions[0], glm::vec3(1, 2, 0));
  EXPECT_EQ(meshOf(scene, 0, 1).primitives[0].positions[0], glm::vec3(1, 0, 0));
  expectMeasured(model);
}

TEST(LodGroup, SkinnedPartsStandWhereTheirJointsAre) {
  GroupModel made = twoLevels();
  tinygltf::Model& model = made.model;
  const int joint = addNode(model, -1, "joint");
  nodeOf(model, joint).translation = {0, 7, 0};
  tinygltf::Skin skin;
  skin.joints = {joint};
  model.skins.push_back(skin);
  nodeOf(model, nodeOf(model, made.finest).children[0]).skin = 0;
  nodeOf(model, made.finest).translation = {100, 0, 0};
  tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
  primitive.attributes["JOINTS_0"] = appendVec4(model, std::vector<glm::vec4>(3, glm::vec4(0)), 0);
  primitive.attributes["WEIGHTS_0"] = appendVec4(model, std::vector<glm::vec4>(3, glm::vec4(1, 0, 0, 0)), 0);
  test::setScene(model, {made.finest, joint});
  const SceneFile scene = readScene(model, "model.glb");
  const glm::vec4 position(meshOf(scene, 0).primitives[0].positions[0], 1);
  EXPECT_EQ(glm::vec3(scene.instances.at(0).worldFromObject * position), glm::vec3(0, 7, 0));
  nodeOf(model, made.finest).scale = {0, 1, 1};
  EXPECT_EQ(test::codeOf([&] { readScene(model, "model.glb"); }), ErrorCode::kUnsupported);
}

TEST(LodGroup, LevelsInsideOfGroupsAreLeftOutAndCounted) {
  GroupModel made = twoLevels();
  const int lower = addNode(made.model, 1);
  setLevels(made.model, nodeOf(made.model, made.finest).children[0], {lower});
  const SceneFile scene = flattenAt(made.model);
  EXPECT_EQ(meshOf(scene, 0).primitives.size(), 2U);
  EXPECT_EQ(scene.ignored, (ContentCounts{{"levels inside of groups with levels", 1}}));
}

TEST(LodGroup, LevelsThatLieWithinEachOtherHaveALimit) {
  tinygltf::Model model;
  const int mesh = addTriangle(model);
  constexpr int kDepth = 2000;
  for (int i = 0; i < kDepth; ++i) {
    addNode(model, i + 1 == kDepth ? mesh : -1);
    if (i > 0) nodeOf(model, i - 1).children = {i};
  }
  std::vector<int> groups;
  for (int i = 0; i < kDepth; ++i) {  // a chain of nodes; each is a level
    const int group = addGroup(model, mesh, "group");
    setLevels(model, group, {i});
    groups.push_back(group);
  }
  test::setScene(model, groups);
  EXPECT_EQ(test::codeOf([&] { readScene(model, "model.glb"); }), ErrorCode::kLimit);
  test::setScene(model, {groups[0], groups[1]});
  EXPECT_EQ(test::codeOf([&] { readScene(model, "model.glb"); }), std::nullopt);
}

TEST(LodGroup, AGroupMayBeALevelOfWhatItHolds) {
  GroupModel made = twoLevels();
  const int outer = addNode(made.model, -1, "outer");
  nodeOf(made.model, outer).children = {made.finest};
  setLevels(made.model, made.finest, {outer});
  test::setScene(made.model, {outer});
  EXPECT_EQ(flattenAt(made.model).chains.at(0).levels.size(), 2U) << "the level above shows what the group shows";
}

}  // namespace
}  // namespace jalousie::asset
