// Occluders in extras: through files, in the flattened scene, and broken ones.
#include "asset/mesh_occluders.h"

#include "asset/asset_fixtures.h"
#include "asset/gltf_json.h"
#include "asset/scene_file.h"

namespace jalousie::asset {
namespace {

const Occluder kBox{solidOf({{0, 0, 0}, {1, 2, 0.5F}}), 3};
const Occluder kPolygon{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, true}, 1};

/// A tetrahedron of side 2 with occluders.
tinygltf::Model tetrahedron(const std::vector<Occluder>& occluders) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  const std::vector<glm::vec3> corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  primitive.attributes["POSITION"] = appendVec3(model, corners, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = appendIndices(model, std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  tinygltf::Mesh mesh;
  mesh.primitives.push_back(primitive);
  mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"author", tinygltf::Value(std::string("someone"))}});
  setOccluders(mesh, occluders);
  model.meshes.push_back(mesh);
  test::addNode(model, 0);
  test::setScene(model, {0});
  return model;
}

tinygltf::Model savedAndRead(const tinygltf::Model& model) {
  return parseGltf(encodeGlb(model), "occluders.glb");
}

/// The first occluder of a mesh, with one member changed.
std::string failureOf(const char* key, tinygltf::Value value) {
  tinygltf::Model model = tetrahedron({kBox});
  tinygltf::Value::Object extras = model.meshes[0].extras.Get<tinygltf::Value::Object>();
  tinygltf::Value::Object first = extras[kOccluders].Get(0).Get<tinygltf::Value::Object>();
  first[key] = std::move(value);
  extras[kOccluders] = tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(std::move(first))});
  model.meshes[0].extras = tinygltf::Value(std::move(extras));
  try {
    savedAndRead(model);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMalformed) << key;
    return error.what();
  }
  return "";
}

TEST(MeshOccluders, ComeBackAsTheyWere) {
  const tinygltf::Mesh mesh = savedAndRead(tetrahedron({kBox, kPolygon})).meshes[0];
  EXPECT_EQ(meshOccluders(mesh), (std::vector<Occluder>{kBox, kPolygon}));
  EXPECT_EQ(mesh.extras.Get("author").Get<std::string>(), "someone");
  tinygltf::Mesh without = mesh;
  setOccluders(without, {});
  EXPECT_TRUE(meshOccluders(without).empty());
  EXPECT_TRUE(without.extras.Has("author"));
}

TEST(MeshOccluders, ReachTheFlattenedScene) {
  const Occluder inside{solidOf({{0.1F, 0.1F, 0.1F}, {0.3F, 0.3F, 0.3F}}), 1};
  const SceneFile file = readScene(savedAndRead(tetrahedron({inside, kPolygon})), "occluders.glb");
  ASSERT_EQ(file.chains.size(), 1U);
  EXPECT_EQ(file.chains[0].occluders, (std::vector<Occluder>{inside, kPolygon}));
}

TEST(MeshOccluders, OutsideOfTheMeshTheyAreRefused) {
  const Occluder outside{solidOf({{0, 0, 0}, {1, 2.5F, 0.5F}}), 1};
  EXPECT_EQ(test::codeOf([&] { savedAndRead(tetrahedron({outside})); }), ErrorCode::kMalformed);
}

TEST(MeshOccluders, LevelsMayBeAbsentAndBothSidesToo) {
  tinygltf::Model model = tetrahedron({kPolygon});
  tinygltf::Value::Object extras = model.meshes[0].extras.Get<tinygltf::Value::Object>();
  tinygltf::Value::Object first = extras[kOccluders].Get(0).Get<tinygltf::Value::Object>();
  first.erase("levels");
  first.erase("bothSides");
  extras[kOccluders] = tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(std::move(first))});
  model.meshes[0].extras = tinygltf::Value(std::move(extras));
  const std::vector<Occluder> read = meshOccluders(savedAndRead(model).meshes[0]);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].levels, 1U);
  EXPECT_FALSE(read[0].solid.bothSides);
}

TEST(MeshOccluders, BrokenValuesAreRefusedWithTheReason) {
  using tinygltf::Value;
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  const Value number(1);
  EXPECT_TRUE(
      has(failureOf("vertices", number), "mesh 0: extras.jalousie_occluders: occluder 0 has no list of vertices"));
  EXPECT_TRUE(has(failureOf("faces", number), "no list of faces"));
  EXPECT_TRUE(has(failureOf("faces", Value(Value::Array{number})), "a face that is no list"));
  EXPECT_TRUE(has(failureOf("levels", Value(-1)), "a number of levels that is no count"));
  EXPECT_TRUE(has(failureOf("levels", Value(1.5)), "a number of levels that is no count"));
  EXPECT_TRUE(has(failureOf("bothSides", number), "neither true nor false"));
  EXPECT_TRUE(has(failureOf("vertices", Value(Value::Array(40, number))), "more than 32 vertices"));
  EXPECT_TRUE(has(failureOf("vertices", Value(Value::Array(8, Value(Value::Array{number, number})))), "three numbers"));
  const Value face(Value::Array{Value(0), Value(1), Value(-2)});
  EXPECT_TRUE(has(failureOf("faces", Value(Value::Array{face})), "a corner that is no count"));
  const Value open(Value::Array{Value(0), Value(1), Value(3), Value(2)});
  EXPECT_NE(failureOf("faces", Value(Value::Array{open})), "") << "vertices without faces";
}

TEST(MeshOccluders, ListsHaveALimit) {
  EXPECT_EQ(test::codeOf([&] { savedAndRead(tetrahedron(std::vector<Occluder>(257, kBox))); }), ErrorCode::kMalformed);
  EXPECT_EQ(meshOccluders(savedAndRead(tetrahedron(std::vector<Occluder>(256, kBox))).meshes[0]).size(), 256U);
}

}  // namespace
}  // namespace jalousie::asset
