// The LOD chain and its extras, in memory and through a file.
#include "asset/lod_chain.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "asset/asset_fixtures.h"
#include "asset/node_graph.h"

namespace jalousie::asset {
namespace {

using test::addNode;
using test::addTriangle;
using test::codeOf;

/// Three levels; node 0 is LOD 0.
tinygltf::Model chainModel() {
  tinygltf::Model model;
  for (std::uint32_t lod = 0; lod < 3; ++lod) {
    const int mesh = addTriangle(model, glm::vec3(static_cast<float>(lod)));
    setLodInfo(model.meshes[static_cast<std::size_t>(mesh)], {lod, 100U >> lod, 60U >> lod, 0.125 * lod});
    addNode(model, mesh, "level");
  }
  setLodChain(model, 0, std::vector<int>{1, 2}, std::vector<float>{0.5F, 0.25F, 0.0F});
  test::setScene(model, {0});
  return model;
}

TEST(LodChain, SurvivesAFile) {
  const test::TempFolder folder;
  saveGlb(chainModel(), folder / "chain.glb");
  const tinygltf::Model model = loadGltf(folder / "chain.glb");
  EXPECT_EQ(lodNodes(model, 0), (std::vector<int>{1, 2}));
  EXPECT_TRUE(lodNodes(model, 1).empty());
  EXPECT_EQ(lodCoverage(model.nodes[0]), (std::vector<float>{0.5F, 0.25F, 0.0F}));
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{"MSFT_lod"});
  const auto info = lodInfo(model.meshes[2]);
  ASSERT_TRUE(info.has_value());
  EXPECT_EQ(info->lod, 2U);
  EXPECT_EQ(info->triangles, 25U);
  EXPECT_EQ(info->vertices, 15U);
  EXPECT_DOUBLE_EQ(info->errorObject, 0.25);
}

TEST(LodChain, MeasuresSurviveAFile) {
  LodMeasures measures{10.0, {0.5, 0.25}, {0.75, 0.125}, {0.75, 0.2}, {3.0, 9.0}, {0.01, 0.03}, 0.5, "enough"};
  tinygltf::Model model = chainModel();
  setLodInfo(model.meshes[2], {2, 25, 15, 0.75, measures});
  const test::TempFolder folder;
  saveGlb(model, folder / "chain.glb");
  const auto info = lodInfo(loadGltf(folder / "chain.glb").meshes[2]);
  ASSERT_TRUE(info && info->measures);
  EXPECT_DOUBLE_EQ(info->measures->diagonal, 10.0);
  EXPECT_DOUBLE_EQ(info->measures->toOriginal.mean, 0.25);
  EXPECT_DOUBLE_EQ(info->measures->fromOriginal.max, 0.75);
  EXPECT_DOUBLE_EQ(info->measures->twoSided.mean, 0.2);
  EXPECT_DOUBLE_EQ(info->measures->normalDegrees.p95, 9.0);
  EXPECT_DOUBLE_EQ(info->measures->uv.mean, 0.01);
  EXPECT_DOUBLE_EQ(info->measures->coverage, 0.5);
  EXPECT_EQ(info->measures->stop, "enough");
}

TEST(LodChain, AMeanIsAFiniteLengthUpToTheMaximum) {
  const auto read = [](double max, double mean) {
    LodMeasures measures{10.0, {0.5, 0.25}, {0.75, 0.125}, {max, mean}, {3.0, 9.0}, {0.01, 0.03}, 0.5, ""};
    tinygltf::Mesh mesh;
    setLodInfo(mesh, {2, 25, 15, 0.75, measures});
    try {
      lodInfo(mesh);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(read(0.75, 0.75), "");
  EXPECT_EQ(read(0.75, 0.75 * (1.0 + 1e-9)), "") << "rounding of a mean of equal distances";
  EXPECT_EQ(read(0.75, 0.76), "extras.jalousie.twoSided: the mean is larger than the maximum");
  EXPECT_EQ(read(0.75, -0.1), "extras.jalousie.mean is negative");
  EXPECT_EQ(read(0.75, std::nan("")), "extras.jalousie.mean is no finite float");
}

TEST(LodChain, TargetsAreReadFromFormat4On) {
  LodMeasures measures{10.0, {0.5, 0.25}, {0.75, 0.125}, {0.75, 0.2}, {3.0, 9.0}, {0.01, 0.03}, 0.5, ""};
  measures.target = 0.8;
  tinygltf::Mesh mesh;
  setLodInfo(mesh, {2, 25, 15, 0.75, measures});
  EXPECT_EQ(lodInfo(mesh)->measures->target, 0.8);
  const auto reread = [&](const char* key, tinygltf::Value value) {
    auto extras = mesh.extras.Get<tinygltf::Value::Object>();
    auto own = extras["jalousie"].Get<tinygltf::Value::Object>();
    own[key] = std::move(value);
    extras["jalousie"] = tinygltf::Value(own);
    tinygltf::Mesh changed;
    changed.extras = tinygltf::Value(extras);
    return lodInfo(changed);
  };
  EXPECT_FALSE(reread("format", tinygltf::Value(3))->measures->target.has_value());
  EXPECT_EQ(codeOf([&] { reread("target", tinygltf::Value(-0.1)); }), ErrorCode::kMalformed);
  EXPECT_EQ(codeOf([&] { reread("target", tinygltf::Value(std::string("0.8"))); }), ErrorCode::kMalformed);
  measures.target.reset();
  setLodInfo(mesh, {2, 25, 15, 0.75, measures});
  EXPECT_FALSE(lodInfo(mesh)->measures->target.has_value());
}

TEST(LodChain, InfoKeepsOtherExtras) {
  tinygltf::Mesh mesh;
  mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"author", tinygltf::Value(std::string("someone"))}});
  setLodInfo(mesh, {1, 2, 3, 4.0});
  EXPECT_EQ(mesh.extras.Get("author").Get<std::string>(), "someone");
  EXPECT_TRUE(lodInfo(mesh).has_value());
}

TEST(LodChain, AbsentInfoIsNoError) {
  EXPECT_FALSE(lodInfo(tinygltf::Mesh()).has_value());
  EXPECT_TRUE(lodCoverage(tinygltf::Node()).empty());
}

TEST(LodChain, BrokenInfoIsMalformed) {
  using Value = tinygltf::Value;
  const auto code = [](const char* key, Value value) {
    tinygltf::Mesh mesh;
    setLodInfo(mesh, {1, 2, 3, 4.0});
    auto extras = mesh.extras.Get<Value::Object>();
    auto own = extras["jalousie"].Get<Value::Object>();
    own[key] = std::move(value);
    extras["jalousie"] = Value(own);
    mesh.extras = Value(extras);
    return codeOf([&] { lodInfo(mesh); });
  };
  EXPECT_EQ(code("format", Value(5)), ErrorCode::kMalformed);
  EXPECT_EQ(code("format", Value(4)), ErrorCode::kMalformed);  // whose measures are missing
  EXPECT_EQ(code("format", Value(0)), ErrorCode::kMalformed);
  EXPECT_EQ(code("format", Value(3)), ErrorCode::kMalformed);  // whose measures are missing
  EXPECT_EQ(code("format", Value(2)), ErrorCode::kMalformed);  // as before
  EXPECT_EQ(code("triangles", Value(-1)), ErrorCode::kMalformed);
  EXPECT_EQ(code("vertices", Value(1.5)), ErrorCode::kMalformed);
  EXPECT_EQ(code("lod", Value(std::string("0"))), ErrorCode::kMalformed);
  EXPECT_EQ(code("errorObject", Value(-0.5)), ErrorCode::kMalformed);
  EXPECT_EQ(code("lod", Value(1)), std::nullopt);
}

TEST(LodChain, IdsOutsideTwiceOrWithoutMeshAreMalformed) {
  const auto code = [](std::vector<int> ids) {
    tinygltf::Model model = chainModel();
    addNode(model, -1, "no mesh");
    tinygltf::Value::Array array;
    for (const int id : ids)
      array.emplace_back(id);
    model.nodes[0].extensions["MSFT_lod"] =
        tinygltf::Value(tinygltf::Value::Object{{"ids", tinygltf::Value(std::move(array))}});
    return codeOf([&] { lodNodes(model, 0); });
  };
  EXPECT_EQ(code({1, 2}), std::nullopt);
  EXPECT_EQ(code({1, 4}), ErrorCode::kMalformed);
  EXPECT_EQ(code({1, -1}), ErrorCode::kMalformed);
  EXPECT_EQ(code({1, 1}), ErrorCode::kMalformed);
  EXPECT_EQ(code({0}), ErrorCode::kMalformed);
  EXPECT_EQ(code({3, 1}), ErrorCode::kMalformed);
}

TEST(LodChain, TheLastLevelMayShowNothing) {
  tinygltf::Model model = chainModel();
  const int empty = addNode(model, -1, "nothing");
  EXPECT_EQ(emptyLevel(model, 0), -1);
  setLodChain(model, 0, std::vector<int>{1, 2, empty}, std::vector<float>{0.5F, 0.25F, 0.125F, 0.0F});
  const test::TempFolder folder;
  saveGlb(model, folder / "chain.glb");
  tinygltf::Model read = loadGltf(folder / "chain.glb");
  EXPECT_EQ(lodNodes(read, 0), (std::vector<int>{1, 2}));
  EXPECT_EQ(emptyLevel(read, 0), empty);
  EXPECT_FALSE(isLodGroup(read, 0));
  EXPECT_EQ(lodThresholds(read.nodes[0], 3), (std::vector<float>{0.5F, 0.25F, 0.125F}));
  read.scenes.clear();
  EXPECT_EQ(sceneRoots(read), std::vector<int>{0}) << "the empty level is no root";
  const int child = addNode(read, read.nodes[2].mesh, "child");
  read.nodes[static_cast<std::size_t>(empty)].children = {child};
  EXPECT_EQ(emptyLevel(read, 0), -1) << "a node with nodes below it is a level";
}

TEST(LodChain, ThresholdsDescendAndAreNumbers) {
  const auto thresholds = [](const char* json, std::size_t levels = 3) {
    tinygltf::Node node;
    tinygltf::Value::Array values;
    for (const auto& value : nlohmann::json::parse(json))
      values.push_back(value.is_number()   ? tinygltf::Value(value.get<double>())
                       : value.is_string() ? tinygltf::Value(value.get<std::string>())
                                           : tinygltf::Value());
    node.extras = tinygltf::Value(tinygltf::Value::Object{{"MSFT_screencoverage", tinygltf::Value(std::move(values))}});
    return lodThresholds(node, levels);
  };
  EXPECT_EQ(thresholds("[0.5, 0.2, 0.01]"), (std::vector<float>{0.5F, 0.2F, 0.01F}));
  EXPECT_EQ(thresholds("[0.5, 0.2, 0.01]", 2), (std::vector<float>{0.5F, 0.2F})) << "more than there are levels";
  EXPECT_EQ(thresholds("[0.5]"), std::vector<float>{0.5F});
  EXPECT_EQ(thresholds("[2, 1, 1]"), (std::vector<float>{2.0F, 1.0F, 1.0F}))
      << "a sphere may be larger than the screen";
  for (const char* broken :
       {"[]", "[0.1, 0.2]", "[0.5, -0.1]", "[0.5, null]", "[\"0.5\"]", "[1e39]", "[0.5, 0.2, 1e300]"})
    EXPECT_TRUE(thresholds(broken).empty()) << broken;
  tinygltf::Node node;
  EXPECT_TRUE(lodThresholds(node, 3).empty());
  node.extras = tinygltf::Value(3);
  EXPECT_TRUE(lodThresholds(node, 3).empty());
  node.extras = tinygltf::Value(tinygltf::Value::Object{{"MSFT_screencoverage", tinygltf::Value(0.5)}});
  EXPECT_TRUE(lodThresholds(node, 3).empty());
}

TEST(LodChain, OneLevelNeedsNoExtension) {
  tinygltf::Model model;
  addNode(model, addTriangle(model));
  setLodChain(model, 0, {}, std::vector<float>{0.0F});
  EXPECT_TRUE(model.extensionsUsed.empty());
  EXPECT_TRUE(lodNodes(model, 0).empty());
}

}  // namespace
}  // namespace jalousie::asset
