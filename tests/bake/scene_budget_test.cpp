// One budget for the meshes of a scene.
#include "bake/simplify/scene_budget.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "asset/accessor.h"
#include "asset/lod_chain.h"
#include "bake/bake_fixtures.h"
#include "bake/io/bake_document.h"
#include "bake/io/node_scales.h"

namespace jalousie::bake {
namespace {

TEST(SceneBudget, CutsAllMeshesAtOneCost) {
  const std::vector<BudgetMesh> meshes = {{100, 1, {{90, 1.0}, {50, 3.0}, {10, 9.0}}, 0.0},
                                          {100, 1, {{60, 2.0}, {30, 4.0}, {10, 20.0}}, 0.0}};
  ChainOptions options;
  options.ratios = {0.75, 0.5, 0.15};
  const auto targets = shareBudget(meshes, options);
  ASSERT_EQ(targets.size(), 2U);
  EXPECT_EQ(targets[0], (std::vector<std::uint32_t>{90, 50, 10}));
  EXPECT_EQ(targets[1], (std::vector<std::uint32_t>{60, 30, 10}));
}

TEST(SceneBudget, CountsEveryNodeAndLeavesOutLevelsThatChangeNothing) {
  const std::vector<BudgetMesh> meshes = {{100, 3, {{20, 1.0}}, 0.0}, {100, 1, {{10, 5.0}}, 0.0}};
  ChainOptions options;
  options.ratios = {0.5, 0.2};  // 200 and 80 of 400 triangles
  const auto targets = shareBudget(meshes, options);
  EXPECT_EQ(targets[0], (std::vector<std::uint32_t>{20}));
  EXPECT_EQ(targets[1], (std::vector<std::uint32_t>{10}));
  EXPECT_TRUE(shareBudget(std::vector<BudgetMesh>(2, BudgetMesh{12, 1, {}, 0.0}), options)[0].empty());
}

int addMesh(tinygltf::Model& model, const asset::Primitive& mesh) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, mesh.positions, 0);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, mesh.normals, 0);
  primitive.indices = asset::appendIndices(model, mesh.indices);
  tinygltf::Node node;
  node.mesh = static_cast<int>(model.meshes.size());
  model.meshes.emplace_back();
  model.meshes.back().primitives = {primitive};
  model.nodes.push_back(node);
  if (model.scenes.empty()) model.scenes.resize(1);
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()) - 1);
  return static_cast<int>(model.nodes.size()) - 1;
}

/// A flat plate, a large sphere and a small one.
tinygltf::Model scene() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  addMesh(model, test::grid(32));
  model.nodes[static_cast<std::size_t>(addMesh(model, test::sphere(48, 24)))].scale = {4.0, 4.0, 4.0};
  model.nodes[static_cast<std::size_t>(addMesh(model, test::sphere(48, 24)))].scale = {0.1, 0.1, 0.1};
  return model;
}

std::vector<MeshReport> bakeIt(tinygltf::Model& model, bool sceneBudget, double ratio) {
  BakeOptions options;
  options.chain.ratios = {ratio};
  options.sceneBudget = sceneBudget;
  return bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
}

struct Total {
  std::uint64_t triangles = 0;
  double error = 0.0;  ///< largest, world units
};

Total totalOf(const std::vector<MeshReport>& reports, const std::vector<double>& scales) {
  Total total;
  for (std::size_t m = 0; m < reports.size(); ++m) {
    total.triangles += reports[m].levels.back().triangles;
    total.error = std::max(total.error, reports[m].levels.back().errorObject * scales[m]);
  }
  return total;
}

TEST(SceneBudget, SpendsTrianglesWhereTheErrorIs) {
  for (const double ratio : {0.25, 0.06}) {
    tinygltf::Model shared = scene();
    tinygltf::Model apart = scene();
    const std::vector<double> scales = {1.0, 4.0, 0.1};
    ASSERT_EQ(nodeScales(shared).size(), 3U);
    EXPECT_NEAR(nodeScales(shared)[1], 4.0, 1e-12);
    const std::vector<MeshReport> together = bakeIt(shared, true, ratio);
    const Total scene = totalOf(together, scales);
    const Total meshes = totalOf(bakeIt(apart, false, ratio), scales);
    EXPECT_LE(scene.triangles, meshes.triangles + 8);
    EXPECT_LT(scene.error, 0.8 * meshes.error) << ratio;
    EXPECT_LT(together[2].levels.back().triangles, together[1].levels.back().triangles);
    EXPECT_LE(together[0].levels.back().triangles, 4U + 2U);  // the plate is flat
  }
}

TEST(SceneBudget, NodeScalesMultiplyDownTheHierarchy) {
  tinygltf::Model model;
  model.nodes.resize(3);
  model.nodes[2].scale = {2.0, 2.0, 2.0};
  model.nodes[2].children = {0};
  model.nodes[0].scale = {1.0, 1.0, 27.0};
  model.nodes[0].children = {1};
  const std::vector<double> scales = nodeScales(model);
  EXPECT_NEAR(scales[2], 2.0, 1e-12);
  EXPECT_NEAR(scales[0], 6.0, 1e-12);
  EXPECT_NEAR(scales[1], 6.0, 1e-12);
}

}  // namespace
}  // namespace jalousie::bake
