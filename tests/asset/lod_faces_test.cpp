// Groups of back faces in the baked format: through files, and broken tables.
#include "asset/lod_faces.h"

#include <gtest/gtest.h>

#include "asset/asset_fixtures.h"
#include "asset/gltf_quantize.h"
#include "asset/lod_chain.h"
#include "asset/scene_file.h"
#include "support/error_code.h"

namespace jalousie::asset {
namespace {

const LodMeasures kGroupedMeasures{10.0, {0.5, 0.25}, {0.75, 0.125}, {0.75, 0.2}, {3.0, 9.0}, {0.01, 0.03}, 0.5, ""};
const LodFaces kFaces{FaceGrouping::kClusters, {{0, 2, 1, 3}, {}}};
const CellTriangles kCells = {{3, 3}, {1, 4}};

/// A mesh with primitives of 6 and 5 triangles, two cells and groups in the first primitive.
tinygltf::Model document() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  tinygltf::Mesh mesh;
  for (const int triangles : {6, 5}) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int t = 0; t < triangles; ++t) {
      for (const glm::vec3 corner : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}) {
        indices.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(corner + glm::vec3(t, 0, 0));
      }
    }
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = appendVec3(model, positions, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.indices = appendIndices(model, indices);
    mesh.primitives.push_back(primitive);
  }
  setLodInfo(mesh, {0, 11, 33, 0.0, kGroupedMeasures});
  setLodCells(mesh, kCells);
  setLodFaces(mesh, kFaces);
  model.meshes.push_back(mesh);
  test::addNode(model, 0);
  test::setScene(model, {0});
  return model;
}

/// The document with other numbers in its table.
tinygltf::Model withTable(tinygltf::Value table) {
  tinygltf::Model model = document();
  tinygltf::Value::Object extras = model.meshes[0].extras.Get<tinygltf::Value::Object>();
  tinygltf::Value::Object own = extras["jalousie"].Get<tinygltf::Value::Object>();
  own["faces"] = std::move(table);
  extras["jalousie"] = tinygltf::Value(std::move(own));
  model.meshes[0].extras = tinygltf::Value(std::move(extras));
  return model;
}

tinygltf::Value list(std::initializer_list<double> numbers) {
  tinygltf::Value::Array values;
  for (const double number : numbers)
    values.emplace_back(number);
  return tinygltf::Value(std::move(values));
}

tinygltf::Value table(const char* kind, std::vector<tinygltf::Value> trees) {
  return tinygltf::Value(tinygltf::Value::Object{{"kind", tinygltf::Value(std::string(kind))},
                                                 {"trees", tinygltf::Value(tinygltf::Value::Array(trees))}});
}

TEST(LodFaces, SurviveEveryKindOfFile) {
  for (const bool quantize : {false, true}) {
    for (const bool compress : {false, true}) {
      tinygltf::Model model = document();
      if (quantize) quantizeModel(model);
      model = parseGltf(encodeGlb(model, {compress}), "faces.glb");
      EXPECT_EQ(lodFaces(model, model.meshes[0]), kFaces) << quantize << compress;
      EXPECT_EQ(lodCells(model, model.meshes[0]), kCells) << quantize << compress;
    }
  }
}

TEST(LodFaces, AreTreesInTheScene) {
  const SceneFile scene = readScene(parseGltf(encodeGlb(document(), {}), "faces.glb"), "faces.glb");
  EXPECT_EQ(scene.meshes.at(0).primitives.at(0).faceTree, kFaces.trees[0]);
  EXPECT_TRUE(scene.meshes.at(0).primitives.at(1).faceTree.empty());
}

TEST(LodFaces, AreAbsentWithoutATableAndInOlderFormats) {
  tinygltf::Model model = document();
  setLodInfo(model.meshes[0], {0, 11, 33, 0.0, kGroupedMeasures});
  EXPECT_EQ(lodFaces(model, model.meshes[0]), LodFaces());
  model = document();
  tinygltf::Value::Object own = model.meshes[0].extras.Get("jalousie").Get<tinygltf::Value::Object>();
  own["format"] = tinygltf::Value(4);
  model.meshes[0].extras = tinygltf::Value(tinygltf::Value::Object{{"jalousie", tinygltf::Value(own)}});
  EXPECT_EQ(lodFaces(model, model.meshes[0]), LodFaces()) << "format 4 has no groups";
  EXPECT_EQ(lodCells(model, model.meshes[0]), kCells);
}

TEST(LodFaces, BrokenTablesAreRefused) {
  const tinygltf::Value good = list({0, 2, 1, 3});
  const tinygltf::Value none(0);
  const std::vector<tinygltf::Value> broken = {
      tinygltf::Value(3),
      table("boxes", {good, none}),
      table("masks", {good}),
      table("masks", {good, none, none}),
      table("masks", {good, tinygltf::Value(1)}),
      table("masks", {good, tinygltf::Value(std::string("0"))}),
      table("masks", {list({6.5}), none}),
      table("masks", {list({-1, 7}), none}),
      table("masks", {list({3, 2}), none}),
      table("masks", {list({3, 3, 1}), none}),
      table("masks", {list({3, 4294967299.0}), none}),
      table("masks", {list({0, 3}), none}),
      table("masks", {list({3, 0, 3}), none}),
      table("masks", {list({2, 2, 2}), none}),
      table("clusters", {list({0, 3, 3}), none}),
  };
  for (std::size_t i = 0; i < broken.size(); ++i) {
    const tinygltf::Model model = withTable(broken[i]);
    EXPECT_EQ(test::codeOf([&] { lodFaces(model, model.meshes[0]); }), ErrorCode::kMalformed) << i;
    EXPECT_EQ(test::codeOf([&] { parseGltf(encodeGlb(model, {}), "faces.glb"); }), ErrorCode::kMalformed) << i;
  }
  const tinygltf::Model whole = withTable(table("masks", {list({3, 3}), none}));
  EXPECT_EQ(lodFaces(whole, whole.meshes[0]).grouping, FaceGrouping::kMasks);
}

}  // namespace
}  // namespace jalousie::asset
