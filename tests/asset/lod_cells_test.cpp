// Cells of the baked format: through files, in the flattened scene, and broken tables.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "asset/asset_fixtures.h"
#include "asset/gltf_quantize.h"
#include "asset/lod_chain.h"
#include "asset/scene_file.h"
#include "asset/scene_size.h"
#include "asset/triangle_count.h"

namespace jalousie::asset {
namespace {

using test::addNode;
using Cells = std::vector<std::uint32_t>;

const LodMeasures kMeasures{10.0, {0.5, 0.25}, {0.75, 0.125}, {0.75, 0.2}, {3.0, 9.0}, {0.01, 0.03}, 0.5, ""};

/// A row of `triangles` separate triangles along x.
tinygltf::Primitive row(tinygltf::Model& model, int triangles) {
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
  primitive.attributes["NORMAL"] =
      appendVec3(model, std::vector<glm::vec3>(positions.size(), glm::vec3(0, 0, 1)), TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = appendIndices(model, indices);
  return primitive;
}

void addLevel(tinygltf::Model& model, const CellTriangles& cells) {
  tinygltf::Mesh mesh;
  std::uint32_t triangles = 0;
  for (const Cells& primitive : cells) {
    const int count = static_cast<int>(std::accumulate(primitive.begin(), primitive.end(), 0U));
    mesh.primitives.push_back(row(model, count));
    triangles += static_cast<std::uint32_t>(count);
  }
  const auto lod = static_cast<std::uint32_t>(model.meshes.size());
  setLodInfo(mesh, {lod, triangles, 3 * triangles, 0.25 * lod, kMeasures});
  setLodCells(mesh, cells);
  model.meshes.push_back(mesh);
  addNode(model, static_cast<int>(lod));
}

const CellTriangles kFine = {{2, 0, 3}, {1, 4, 1}};
const CellTriangles kCoarse = {{3, 0, 0}};  // the second material is gone

tinygltf::Model chain() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  addLevel(model, kFine);
  addLevel(model, kCoarse);
  setLodChain(model, 0, std::vector<int>{1}, std::vector<float>{0.5F, 0.0F});
  test::setScene(model, {0});
  return model;
}

tinygltf::Model throughFile(const tinygltf::Model& model, bool compress = false) {
  return parseGltf(encodeGlb(model, {compress}), "cells.glb");
}

/// The x of the first corner of each triangle, which is its number in `row`.
std::vector<int> rowOrder(const Primitive& primitive) {
  std::vector<int> order;
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
    float least = 1e9F;
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, primitive.positions[primitive.indices[i + k]].x);
    order.push_back(static_cast<int>(least));
  }
  return order;
}

TEST(LodCells, SurviveEveryKindOfFile) {
  for (const bool quantize : {false, true}) {
    for (const bool compress : {false, true}) {
      tinygltf::Model model = chain();
      if (quantize) quantizeModel(model);
      model = throughFile(model, compress);
      EXPECT_EQ(lodCells(model, model.meshes[0]), kFine) << quantize << compress;
      EXPECT_EQ(lodCells(model, model.meshes[1]), kCoarse) << quantize << compress;
      EXPECT_EQ(cellCount(kFine), 3U);
    }
  }
}

TEST(LodCells, CompressionKeepsTheOrderOfTriangles) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  addLevel(model, {{100, 200}});
  test::setScene(model, {0});
  std::vector<int> expected(300);
  std::iota(expected.begin(), expected.end(), 0);
  const tinygltf::Model compressed = throughFile(model, true);
  EXPECT_LT(encodeGlb(model, {true}).size(), encodeGlb(model, {false}).size() / 2);
  EXPECT_EQ(rowOrder(readScene(compressed, "cells.glb").meshes.at(0).primitives.at(0)), expected);
}

TEST(LodCells, AreIndicesInTheScene) {
  const tinygltf::Model model = throughFile(chain());
  const SceneFile scene = readScene(model, "cells.glb");
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(scene.meshes[0].primitives.at(0).cellEnds, (Cells{6, 6, 15}));
  EXPECT_EQ(scene.meshes[0].primitives.at(1).cellEnds, (Cells{3, 15, 18}));
  EXPECT_EQ(scene.meshes[1].primitives.at(0).cellEnds, (Cells{9, 9, 9}));
  EXPECT_EQ(measureScene(model).cellEnds, 9U);
}

TEST(LodCells, FlatPrimitivesKeepTheirOrder) {
  tinygltf::Model model = chain();
  for (tinygltf::Primitive& primitive : model.meshes[0].primitives)
    primitive.attributes.erase("NORMAL");
  const SceneFile scene = readScene(throughFile(model), "cells.glb");
  EXPECT_EQ(scene.meshes[0].primitives.at(1).cellEnds, (Cells{3, 15, 18}));
  EXPECT_EQ(rowOrder(scene.meshes[0].primitives.at(1)), (std::vector<int>{0, 1, 2, 3, 4, 5}));
}

TEST(LodCells, StripsCountTheirTrianglesAndPointsHaveNone) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  addLevel(model, {{2}, {3}});
  tinygltf::Mesh& mesh = model.meshes[0];
  mesh.primitives[0].mode = TINYGLTF_MODE_POINTS;
  mesh.primitives[1].mode = TINYGLTF_MODE_TRIANGLE_STRIP;  // of 9 corners
  setLodCells(mesh, {{0, 0}, {3, 4}});
  test::setScene(model, {0});
  EXPECT_EQ(triangleCount(model, mesh.primitives[0]), 0U);
  EXPECT_EQ(triangleCount(model, mesh.primitives[1]), 7U);
  const SceneFile scene = readScene(throughFile(model), "cells.glb");
  ASSERT_EQ(scene.meshes.at(0).primitives.size(), 1U);
  EXPECT_EQ(scene.meshes[0].primitives[0].cellEnds, (Cells{9, 21}));
  EXPECT_EQ(scene.meshes[0].primitives[0].indices.size(), 21U);
}

TEST(LodCells, PlainFilesHaveNone) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  addNode(model, test::addTriangle(model));
  test::setScene(model, {0});
  EXPECT_TRUE(readScene(throughFile(model), "plain.glb").meshes.at(0).primitives.at(0).cellEnds.empty());
  EXPECT_EQ(measureScene(model).cellEnds, 0U);
}

TEST(LodCells, NewInfoRemovesThem) {
  tinygltf::Model model = chain();
  setLodInfo(model.meshes[0], {0, 11, 33, 0.0, kMeasures});
  EXPECT_TRUE(lodCells(model, model.meshes[0]).empty());
}

nlohmann::json jsonOf(const std::vector<std::byte>& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const char* text = reinterpret_cast<const char*>(glb.data()) + 20;
  return nlohmann::json::parse(text, text + length);
}

/// The same file with other JSON.
std::string withJson(const std::vector<std::byte>& glb, const nlohmann::json& document) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const char* binary = reinterpret_cast<const char*>(glb.data()) + 28 + length;
  return test::glb(document.dump(), std::string(binary, reinterpret_cast<const char*>(glb.data() + glb.size())));
}

/// The message about a file whose JSON has one other value; empty if it can be read.
std::string refusal(const std::string& pointer, const nlohmann::json& value) {
  const std::vector<std::byte> good = encodeGlb(chain());
  nlohmann::json document = jsonOf(good);
  document.at(nlohmann::json::json_pointer(pointer)) = value;
  const std::string bad = withJson(good, document);
  try {
    readScene(parseGltf(std::as_bytes(std::span(bad)), "bad.glb"), "bad.glb");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMalformed) << error.what();
    return error.what();
  }
  return {};
}

TEST(LodCells, BrokenTablesAreRefusedWithTheReason) {
  const std::string cells = "/meshes/0/extras/jalousie/cells";
  const std::string lists = cells + "/triangles";
  const auto expect = [](const std::string& pointer, const nlohmann::json& value, const std::string& reason) {
    const std::string message = refusal(pointer, value);
    EXPECT_NE(message.find(reason), std::string::npos) << pointer << " " << value << ": " << message;
  };
  expect(cells, 3, "mesh 0: extras.jalousie.cells is not an object");
  expect(lists, 3, "mesh 0: extras.jalousie.cells.triangles is not a list");
  expect(lists, CellTriangles{{2, 0, 3}}, "mesh 0: extras.jalousie.cells has 1 lists for 2 primitives");
  expect(lists, CellTriangles{{2, 0, 3}, {6}}, "mesh 0: extras.jalousie.cells: primitives 0 and 1 have 3 and 1 cells");
  expect(lists + "/1", 6, "primitive 1 has no list");
  expect(lists + "/1/0", 2, "primitive 1 has 6 triangles, its cells have 7");
  expect(lists + "/1/0", -1, "primitive 1 has no count of triangles for cell 0");
  expect(lists + "/1/1", 0.5, "primitive 1 has no count of triangles for cell 1");
  expect(lists + "/1/1", "4", "primitive 1 has no count of triangles for cell 1");
  expect(lists + "/1/1", 1e300, "primitive 1 has no count of triangles for cell 1");
  expect(lists + "/1/2", 2147483647, "primitive 1 has 6 triangles, its cells have 2147483652");
  expect(lists + "/1/2", 4294967297, "extras.jalousie holds a number above 2^31 - 1");
  expect(lists, CellTriangles{{2, 0, 3, 0}, {1, 4, 1, 0}},
         "node 0: mesh 1 has 3 cells, mesh 0 of the same chain has 4");
  EXPECT_EQ(refusal(lists + "/1/1", 4.0), "") << "other writers may write whole numbers like this";
}

TEST(LodCells, ALevelWithoutThemIsRefused) {
  for (const std::size_t level : {0U, 1U}) {
    const std::vector<std::byte> good = encodeGlb(chain());
    nlohmann::json document = jsonOf(good);
    document["meshes"][level]["extras"]["jalousie"].erase("cells");
    const std::string bad = withJson(good, document);
    try {
      parseGltf(std::as_bytes(std::span(bad)), "bad.glb");
      ADD_FAILURE() << level;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kMalformed);
      const char* reason = level == 0 ? "mesh 1 has 3 cells, mesh 0 of the same chain has 0"
                                      : "mesh 1 has 0 cells, mesh 0 of the same chain has 3";
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
}

TEST(LodCells, LevelsWhoseMeshDoesNotExistAreRefused) {
  for (const std::string node : {"0", "1"}) {
    for (const int mesh : {2, 1'000'000, 2147483647})
      EXPECT_NE(refusal("/nodes/" + node + "/mesh", mesh).find("node " + node + ": mesh"), std::string::npos) << mesh;
  }
}

TEST(LodCells, OlderFormatsHaveNone) {
  const std::vector<std::byte> good = encodeGlb(chain());
  for (const int format : {1, 2}) {
    nlohmann::json document = jsonOf(good);
    for (nlohmann::json& mesh : document["meshes"])
      mesh["extras"]["jalousie"]["format"] = format;
    const std::string old = withJson(good, document);
    const tinygltf::Model model = parseGltf(std::as_bytes(std::span(old)), "old.glb");
    EXPECT_TRUE(lodCells(model, model.meshes[0]).empty()) << format;
    EXPECT_EQ(lodInfo(model.meshes[1])->measures.has_value(), format == 2);
  }
}

}  // namespace
}  // namespace jalousie::asset
