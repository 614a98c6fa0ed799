// Scenes at a time: animated nodes, skins, morph targets.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asset/asset_fixtures.h"
#include "asset/ignored_content.h"
#include "asset/node_motion.h"
#include "asset/scene_file.h"

namespace jalousie::asset {
namespace {

SceneFile at(const tinygltf::Model& model, std::optional<double> seconds) {
  return readScene(model, "model.glb", {}, {.check = {}, .seconds = seconds});
}

/// One triangle in node 0, which stands at x = 10.
tinygltf::Model movedTriangle() {
  tinygltf::Model model;
  test::addNode(model, test::addTriangle(model), "thing");
  test::setScene(model, {0});
  model.nodes[0].translation = {10, 0, 0};
  return model;
}

void animate(tinygltf::Model& model, int node, const char* path, const char* interpolation, int output,
             const std::vector<float>& times) {
  tinygltf::Animation animation;
  tinygltf::AnimationSampler sampler;
  sampler.input = appendScalars(model, times, 0);
  sampler.output = output;
  sampler.interpolation = interpolation;
  animation.samplers.push_back(sampler);
  tinygltf::AnimationChannel channel;
  channel.sampler = 0;
  channel.target_node = node;
  channel.target_path = path;
  animation.channels.push_back(channel);
  model.animations.push_back(animation);
}

/// The positions of a scene's only object in the world.
std::vector<glm::vec3> worldPositions(const SceneFile& scene) {
  std::vector<glm::vec3> positions;
  const Instance& instance = scene.instances.at(0);
  for (const Primitive& primitive : scene.meshes[scene.chains[instance.chain].levels[0].mesh].primitives)
    for (const glm::vec3& p : primitive.positions)
      positions.emplace_back(instance.worldFromObject * glm::vec4(p, 1.0F));
  return positions;
}

void expectNear(const std::vector<glm::vec3>& actual, const std::vector<glm::vec3>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i)
    EXPECT_LT(glm::distance(actual[i], expected[i]), 1e-5F) << i;
}

std::vector<glm::vec3> moved(std::vector<glm::vec3> positions, const glm::vec3& by) {
  for (glm::vec3& p : positions)
    p += by;
  return positions;
}

TEST(ScenePose, AnimatedNodesStandWhereTheirTimeSays) {
  tinygltf::Model model = movedTriangle();
  animate(model, 0, "translation", "LINEAR", appendVec3(model, std::vector<glm::vec3>{{0, 0, 0}, {0, 4, 0}}, 0),
          {1, 3});
  const std::vector<glm::vec3> origin = moved(worldPositions(at(model, std::nullopt)), {-10, 0, 0});
  expectNear(worldPositions(at(model, 0.0)), origin);
  expectNear(worldPositions(at(model, 2.5)), moved(origin, {0, 3, 0}));
  expectNear(worldPositions(at(model, 99.0)), moved(origin, {0, 4, 0}));
  EXPECT_EQ(at(model, std::nullopt).ignored, (ContentCounts{{"animation channels", 1}}));
  EXPECT_TRUE(at(model, 0.0).ignored.empty());
}

TEST(ScenePose, EveryInterpolationFollowsTheSpecification) {
  tinygltf::Model model = movedTriangle();
  animate(model, 0, "scale", "STEP", appendVec3(model, std::vector<glm::vec3>{{1, 1, 1}, {2, 3, 4}}, 0), {0, 2});
  const float half = std::sqrt(0.5F);
  animate(model, 0, "rotation", "LINEAR",
          appendVec4(model, std::vector<glm::vec4>{{0, 0, 0, 1}, {0, 0, half, half}}, 0), {0, 2});
  // In-tangent, value, out-tangent of each key.
  animate(
      model, 0, "translation", "CUBICSPLINE",
      appendVec3(model, std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {4, 0, 0}, {0, 8, 0}, {3, 0, 0}, {0, 0, 0}}, 0),
      {0, 2});
  const Limits limits;
  NodeMotion motion(model, limits);
  const glm::dmat4 middle = motion.transformAt(0, 1.0);
  // Hermite at the middle of two seconds: (a + b) / 2 + 2 (leaving - arriving) / 8.
  EXPECT_LT(glm::distance(glm::dvec3(middle[3]), glm::dvec3(2.0 + 1.0, -2.0, 0.0)), 1e-6);
  EXPECT_LT(glm::distance(glm::dvec3(middle[0]), glm::dvec3(std::sqrt(0.5), std::sqrt(0.5), 0.0)), 1e-6)
      << "an eighth of a turn, not yet scaled";
  const glm::dmat4 end = motion.transformAt(0, 2.0);
  EXPECT_LT(glm::distance(glm::dvec3(end[0]), glm::dvec3(0.0, 2.0, 0.0)), 1e-6);
  EXPECT_EQ(motion.lastKey(0), 2.0F);
}

/// The triangle with two joints, nodes 1 and 2: the first vertex follows one, the second the other, the third both.
tinygltf::Model skinned() {
  tinygltf::Model model = movedTriangle();
  std::map<std::string, int>& attributes = model.meshes[0].primitives[0].attributes;
  attributes["JOINTS_0"] = appendVec4(model, std::vector<glm::vec4>{{0, 9, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}, 0);
  attributes["WEIGHTS_0"] =
      appendVec4(model, std::vector<glm::vec4>{{1, 0, 0, 0}, {1, 0, 0, 0}, {0.25F, 0.75F, 0, 0}}, 0);
  for (const double x : {100.0, 200.0}) {
    tinygltf::Node joint;
    joint.translation = {x, 0, 0};
    model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(joint);
  }
  tinygltf::Skin skin;
  skin.joints = {1, 2};
  model.skins.push_back(skin);
  model.nodes[0].skin = 0;
  return model;
}

TEST(ScenePose, SkinsPlaceVerticesByTheirJoints) {
  const std::vector<glm::vec3> rest = moved(worldPositions(at(movedTriangle(), std::nullopt)), {-10, 0, 0});
  const tinygltf::Model model = skinned();
  const SceneFile scene = at(model, std::nullopt);
  EXPECT_EQ(scene.instances.at(0).worldFromObject, glm::mat4(1.0F)) << "the node's own place has no effect";
  expectNear(worldPositions(scene),
             {rest[0] + glm::vec3(100, 0, 0), rest[1] + glm::vec3(200, 0, 0), rest[2] + glm::vec3(175, 0, 0)});
}

TEST(ScenePose, SkinsFollowAnimatedJoints) {
  tinygltf::Model model = skinned();
  animate(model, 2, "translation", "LINEAR", appendVec3(model, std::vector<glm::vec3>{{0, 0, 0}, {0, 8, 0}}, 0),
          {0, 1});
  const std::vector<glm::vec3> rest = worldPositions(at(model, 0.0));
  const std::vector<glm::vec3> later = worldPositions(at(model, 0.5));
  EXPECT_LT(glm::distance(later[0], rest[0]), 1e-5F);
  EXPECT_LT(glm::distance(later[1], rest[1] + glm::vec3(0, 4, 0)), 1e-5F);
  EXPECT_LT(glm::distance(later[2], rest[2] + glm::vec3(0, 3, 0)), 1e-5F);
}

TEST(ScenePose, JointsThatDoNotExistAreMalformed) {
  tinygltf::Model model = skinned();
  model.skins[0].joints.pop_back();
  EXPECT_EQ(test::codeOf([&] { at(model, std::nullopt); }), ErrorCode::kMalformed);
}

TEST(ScenePose, MorphTargetsMoveByTheirWeights) {
  tinygltf::Model model = movedTriangle();
  const std::vector<glm::vec3> rest = worldPositions(at(model, std::nullopt));
  const int offsets = appendVec3(model, std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}, 0);
  const int others = appendVec3(model, std::vector<glm::vec3>{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}, 0);
  model.meshes[0].primitives[0].targets = {{{"POSITION", offsets}}, {{"POSITION", others}}};
  model.meshes[0].weights = {0.5, 2.0};
  const auto expected = [&](float first, float second) {
    return std::vector<glm::vec3>{rest[0] + glm::vec3(second, 0, first), rest[1] + glm::vec3(second, 0, 2 * first),
                                  rest[2] + glm::vec3(second, 0, 3 * first)};
  };
  expectNear(worldPositions(at(model, std::nullopt)), expected(0.5F, 2.0F));
  model.nodes[0].weights = {1.0, 0.0};
  expectNear(worldPositions(at(model, std::nullopt)), expected(1.0F, 0.0F));
  animate(model, 0, "weights", "LINEAR", appendScalars(model, std::vector<float>{0, 0, 2, 4}, 0), {0, 1});
  expectNear(worldPositions(at(model, 0.25)), expected(0.5F, 1.0F));
}

TEST(ScenePose, NodesWithPosesOfTheirOwnShareNoMesh) {
  tinygltf::Model model = skinned();
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
  model.nodes.push_back(model.nodes[0]);
  model.nodes.back().skin = -1;
  const SceneFile scene = at(model, std::nullopt);
  ASSERT_EQ(scene.instances.size(), 2U);
  EXPECT_NE(scene.instances[0].chain, scene.instances[1].chain);
  EXPECT_EQ(scene.meshes.size(), 2U);
}

}  // namespace
}  // namespace jalousie::asset
