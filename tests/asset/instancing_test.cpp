// Instances written to and read from EXT_mesh_gpu_instancing.
#include "asset/instancing.h"

#include <glm/gtc/matrix_transform.hpp>

#include "asset/asset_fixtures.h"

namespace jalousie::asset {
namespace {

using test::codeOf;

Instances threeInstances() {
  Instances instances;
  instances.translations = {{0, 0, 0}, {1, 2, 3}, {-4, 0.5F, 6}};
  instances.rotations = {glm::quat(1, 0, 0, 0), glm::quat(0, 1, 0, 0), glm::quat(0.6F, 0, 0.8F, 0)};
  instances.scales = {{1, 1, 1}, {2, 2, 2}, {1, 0.5F, -1}};
  return instances;
}

tinygltf::Model instancedModel() {
  tinygltf::Model model;
  test::addNode(model, test::addTriangle(model));
  model.nodes[0].extensions["EXT_mesh_gpu_instancing"] = appendInstances(model, threeInstances());
  test::setScene(model, {0});
  return model;
}

TEST(Instancing, SurvivesAFile) {
  const test::TempFolder folder;
  saveGlb(instancedModel(), folder / "instanced.glb");
  const tinygltf::Model model = loadGltf(folder / "instanced.glb");
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{"EXT_mesh_gpu_instancing"});
  const Instances read = readInstances(model, 0).values;
  const Instances expected = threeInstances();
  EXPECT_EQ(read.translations, expected.translations);
  EXPECT_EQ(read.scales, expected.scales);
  ASSERT_EQ(read.rotations.size(), 3U);
  EXPECT_NEAR(glm::dot(read.rotations[2], expected.rotations[2]), 1.0F, 1e-6F);
}

TEST(Instancing, AccessorsOutliveTheRenumberingOfEncode) {
  tinygltf::Model model = instancedModel();
  // Unused accessors before and behind the used ones move all indices.
  model.accessors.insert(model.accessors.begin(), model.accessors[0]);
  for (auto& [name, accessor] : model.meshes[0].primitives[0].attributes)
    ++accessor;
  ++model.meshes[0].primitives[0].indices;
  tinygltf::Value::Object attributes =
      model.nodes[0].extensions["EXT_mesh_gpu_instancing"].Get("attributes").Get<tinygltf::Value::Object>();
  for (auto& [name, value] : attributes)
    value = tinygltf::Value(value.Get<int>() + 1);
  model.nodes[0].extensions["EXT_mesh_gpu_instancing"] =
      tinygltf::Value(tinygltf::Value::Object{{"attributes", tinygltf::Value(attributes)}});
  EXPECT_EQ(encodeGlb(model), encodeGlb(instancedModel()));
}

TEST(Instancing, MissingAttributesAreIdentity) {
  tinygltf::Model model;
  test::addNode(model, test::addTriangle(model));
  EXPECT_EQ(readInstances(model, 0).count, 0U);
  const int scale = appendVec3(model, std::vector<glm::vec3>{{2, 2, 2}, {3, 3, 3}}, 0);
  tinygltf::Value::Object attributes{{"SCALE", tinygltf::Value(scale)}};
  model.nodes[0].extensions["EXT_mesh_gpu_instancing"] =
      tinygltf::Value(tinygltf::Value::Object{{"attributes", tinygltf::Value(attributes)}});
  const InstanceTransforms read = readInstances(model, 0);
  EXPECT_EQ(read.count, 2U);
  EXPECT_FALSE(read.areEqual());
  EXPECT_EQ(read.nodeFromInstance(0), glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)));
  EXPECT_EQ(read.nodeFromInstance(1), glm::scale(glm::dmat4(1.0), glm::dvec3(3.0)));
}

TEST(Instancing, AccessorsWithoutDataAreNotExpanded) {
  tinygltf::Model model = instancedModel();
  tinygltf::Accessor zeros;
  zeros.type = TINYGLTF_TYPE_VEC3;
  zeros.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  zeros.count = std::size_t{1} << 24U;
  model.accessors.push_back(zeros);
  const int accessor = static_cast<int>(model.accessors.size()) - 1;
  model.nodes[0].extensions["EXT_mesh_gpu_instancing"] = tinygltf::Value(tinygltf::Value::Object{
      {"attributes", tinygltf::Value(tinygltf::Value::Object{{"TRANSLATION", tinygltf::Value(accessor)}})}});
  const InstanceTransforms read = readInstances(model, 0);
  EXPECT_EQ(read.count, zeros.count);
  EXPECT_TRUE(read.areEqual());
  EXPECT_EQ(read.values.translations.size(), 1U);
  EXPECT_EQ(read.nodeFromInstance(read.count - 1), glm::dmat4(1.0));
}

TEST(Instancing, DifferentCountsAreMalformed) {
  tinygltf::Model model = instancedModel();
  model.accessors.back().count = 2;
  EXPECT_EQ(codeOf([&] { readInstances(model, 0); }), ErrorCode::kMalformed);
}

TEST(Instancing, CountAboveTheLimitIsRefused) {
  const tinygltf::Model model = instancedModel();
  Limits limits;
  limits.maxInstances = 3;
  EXPECT_EQ(countInstances(model, 0, limits), 3U);
  limits.maxInstances = 2;
  try {
    countInstances(model, 0, limits);
    ADD_FAILURE() << "three instances pass a limit of two";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kLimit);
    EXPECT_STREQ(error.what(), "node 0: 3 instances, the limit is 2");
  }
  EXPECT_EQ(codeOf([&] { readInstances(model, 0, limits); }), ErrorCode::kLimit);
}

/// Attributes that are not read are not counted by any accessor's own limit.
TEST(Instancing, CountOfUnknownAttributesHasTheLimit) {
  tinygltf::Model model = instancedModel();
  const int accessor = appendScalars(model, std::vector<float>{0, 1, 2}, 0);
  model.nodes[0].extensions["EXT_mesh_gpu_instancing"] = tinygltf::Value(tinygltf::Value::Object{
      {"attributes", tinygltf::Value(tinygltf::Value::Object{{"_ID", tinygltf::Value(accessor)}})}});
  Limits limits;
  limits.maxInstances = 3;
  EXPECT_EQ(readInstances(model, 0, limits).count, 3U);
  limits.maxInstances = 2;
  EXPECT_EQ(codeOf([&] { readInstances(model, 0, limits); }), ErrorCode::kLimit);
  EXPECT_EQ(codeOf([&] { checkInstances(model, 0, limits); }), ErrorCode::kLimit);
}

}  // namespace
}  // namespace jalousie::asset
