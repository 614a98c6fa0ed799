// One budget for the meshes of a scene.
#include "bake/simplify/scene_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "asset/accessor.h"
#include "asset/instancing.h"
#include "asset/lod_chain.h"
#include "bake/bake_fixtures.h"
#include "bake/io/bake_document.h"
#include "bake/io/node_scales.h"
#include "bake/io/touching_meshes.h"

namespace jalousie::bake {
namespace {

TEST(SceneBudget, CutsAllMeshesAtOneCost) {
  const std::vector<BudgetMesh> meshes = {{100, 1, {{90, 1.0}, {50, 3.0}, {10, 9.0}}, 0.0},
                                          {100, 1, {{60, 2.0}, {30, 4.0}, {10, 20.0}}, 0.0}};
  ChainOptions options;
  options.ratios = {0.75, 0.5, 0.15};
  const auto targets = shareBudget(meshes, options);
  ASSERT_EQ(targets.size(), 2U);
  EXPECT_EQ(targets[0], (std::vector<std::uint32_t>{57, 10}));  // 90 of 100 and 50 of 57 are no steps
  EXPECT_EQ(targets[1], (std::vector<std::uint32_t>{60, 30, 10}));
}

TEST(SceneBudget, CountsEveryNodeAndLeavesOutLevelsThatChangeNothing) {
  const std::vector<BudgetMesh> meshes = {{100, 3, {{20, 1.0}}, 0.0}, {100, 1, {{10, 5.0}}, 0.0}};
  ChainOptions options;
  options.ratios = {0.5, 0.25};  // 200 and 100 of 400 triangles
  const auto targets = shareBudget(meshes, options);
  EXPECT_EQ(targets[0], (std::vector<std::uint32_t>{25, 20}));
  EXPECT_EQ(targets[1], (std::vector<std::uint32_t>{25}));
  EXPECT_TRUE(shareBudget(std::vector<BudgetMesh>(2, BudgetMesh{12, 1, {}, 0.0}), options)[0].empty());
}

TEST(SceneBudget, LeavesMeshesOutWhereThatIsCheapest) {
  // The second mesh costs 3 to leave out, the third may not be left out.
  std::vector<BudgetMesh> meshes = {
      {1000, 1, {{500, 1.0}, {250, 2.0}, {100, 4.0}, {4, 8.0}}, 10.0}, {12, 2, {{8, 2.0}}, 0.5}, {12, 2, {}, 0.5}};
  meshes[1].removal = 3.0;
  ChainOptions options;
  options.ratios = {0.5, 0.25, 0.12};
  const auto targets = shareBudget(meshes, options);
  EXPECT_EQ(targets[0], (std::vector<std::uint32_t>{250, 100})) << "the first level fits only after the step to 250";
  EXPECT_EQ(targets[1], (std::vector<std::uint32_t>{8, 0}));
  EXPECT_TRUE(targets[2].empty());
  meshes[1].triangles = 40;
  meshes[1].costs = {};
  const auto kept = shareBudget(meshes, options);
  EXPECT_TRUE(kept[1].empty() || kept[1][0] != 0) << "a quarter of 40 triangles is a level";
}

TEST(SceneBudget, NoMeshFallsFarBelowItsShareUnlessNobodySeesIt) {
  // The first mesh is cheap, the others are dear: without a floor it would pay for them.
  const std::vector<CostPoint> cheap = {{500, 1.0}, {100, 2.0}, {10, 3.0}};
  const std::vector<CostPoint> dear = {{700, 100.0}, {10, 200.0}};
  std::vector<BudgetMesh> meshes = {{1000, 1, cheap, 0.0}, {1000, 1, dear, 0.0}};
  ChainOptions options;
  options.ratios = {0.6, 0.3};
  auto targets = shareBudget(meshes, options);
  EXPECT_EQ(targets[0], (std::vector<std::uint32_t>{360, 90}));  // 0.6^2 of 1000, then 0.5^2 of that
  EXPECT_EQ(targets[1].size(), 2U);
  meshes[0].unseen = 10;
  targets = shareBudget(meshes, options);
  EXPECT_EQ(targets[0], (std::vector<std::uint32_t>{100, 10}));
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

/// Half a bumpy sphere; the halves of both signs share the vertices of their rim.
asset::Primitive halfSphere(float sign) {
  constexpr std::uint32_t kAround = 64;
  constexpr std::uint32_t kUp = 16;
  asset::Primitive mesh;
  for (std::uint32_t j = 0; j <= kUp; ++j) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const float a = 6.2831853F * static_cast<float>(i) / kAround;
      const float b = j == 0 ? 0.0F : 1.5F * static_cast<float>(j) / kUp;
      const float r = 1.0F + 0.1F * std::sin(5.0F * a);
      mesh.positions.emplace_back(r * std::cos(a) * std::cos(b), sign * std::sin(b), r * std::sin(a) * std::cos(b));
      mesh.normals.push_back(glm::normalize(mesh.positions.back()));
    }
  }
  for (std::uint32_t j = 0; j < kUp; ++j) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = j * kAround + i;
      const std::uint32_t b = j * kAround + (i + 1) % kAround;
      const std::array<std::uint32_t, 6> quad = {a, a + kAround, b, b, a + kAround, b + kAround};
      mesh.indices.insert(mesh.indices.end(), quad.begin(), quad.end());
      if (sign < 0.0F) std::swap(mesh.indices[mesh.indices.size() - 2], mesh.indices.back());
      if (sign < 0.0F) std::swap(mesh.indices[mesh.indices.size() - 5], mesh.indices[mesh.indices.size() - 4]);
    }
  }
  return mesh;
}

/// The positions of the vertices near the rim, in order.
std::vector<std::array<float, 3>> rimOf(const tinygltf::Model& model, int mesh) {
  const tinygltf::Primitive& primitive = model.meshes[static_cast<std::size_t>(mesh)].primitives[0];
  std::vector<std::array<float, 3>> rim;
  for (const glm::vec3& p : asset::readVec3(model, primitive.attributes.at("POSITION"), 1U << 20U))
    if (std::abs(p.y) < 1e-3F) rim.push_back({p.x, p.y, p.z});
  std::sort(rim.begin(), rim.end());
  return rim;
}

TEST(SceneBudget, NothingOpensBetweenMeshesThatTouch) {
  for (const bool shared : {true, false}) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    addMesh(model, halfSphere(1.0F));
    addMesh(model, halfSphere(-1.0F));
    const std::vector<std::array<float, 3>> rim = rimOf(model, 0);
    ASSERT_EQ(rim.size(), 64U);
    const std::vector<MeshReport> reports = bakeIt(model, shared, 0.25);
    ASSERT_EQ(reports[0].levels.size(), 2U);
    ASSERT_EQ(reports[1].levels.size(), 2U);
    EXPECT_LE(reports[0].levels[1].triangles + reports[1].levels[1].triangles, 1024U + 1U);
    const std::vector<std::array<float, 3>> upper = rimOf(model, 2);
    const std::vector<std::array<float, 3>> lower = rimOf(model, 3);
    EXPECT_EQ(upper == rim && lower == rim, shared) << upper.size() << " and " << lower.size();
  }
}

TEST(SceneBudget, EqualPlacesInTheSceneTouch) {
  using Places = std::vector<glm::vec3>;
  const Places first = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const Places second = {{2, 0, 0}, {-0.0F, 0, 0}, {3, 0, 0}};
  const glm::dmat4 here(1.0);
  const glm::dmat4 twice = glm::scale(here, glm::dvec3(2.0));
  const auto touching =
      touchingPlaces(std::vector<MeshBorder>{{{here}, first}, {{twice, here}, second}, {{twice}, first}});
  EXPECT_EQ(touching[0], (Places{{0, 0, 0}, {2, 0, 0}}));
  EXPECT_EQ(touching[1], (Places{{0, 0, 0}, {2, 0, 0}}));
  EXPECT_EQ(touching[2], first);
  // Copies of one mesh side by side touch, but not two at one place.
  const Places tile = {{0, 0, 0}, {0.1F, 0, 0}, {0.3F, 0, 0}};
  const glm::dmat4 beside = glm::translate(here, glm::dvec3(0.3, 0.0, 0.0));
  EXPECT_EQ(touchingPlaces(std::vector<MeshBorder>{{{here, beside}, tile}})[0], (Places{{0, 0, 0}, {0.3F, 0, 0}}));
  EXPECT_TRUE(touchingPlaces(std::vector<MeshBorder>{{{here, here}, tile}})[0].empty());
  // Rotations round: a millionth of the scene is no gap, a thousandth is.
  const glm::dmat4 turned = glm::rotate(here, 1.0, glm::dvec3(0.0, 0.0, 1.0));
  const glm::vec3 end(turned * glm::dvec4(0.3, 0.0, 0.0, 1.0));
  EXPECT_EQ(touchingPlaces(std::vector<MeshBorder>{{{turned}, tile}, {{here}, {end, {1, 1, 1}}}})[1], Places{end});
  const glm::vec3 off = end + glm::vec3(1e-3F, 0.0F, 0.0F);
  EXPECT_TRUE(touchingPlaces(std::vector<MeshBorder>{{{turned}, tile}, {{here}, {off, {1, 1, 1}}}})[1].empty());
  EXPECT_TRUE(touchingPlaces(std::vector<MeshBorder>{{{here}, {}}, {{here}, {{1, 1, 1}}}})[1].empty());
}

TEST(SceneBudget, ManyPlacesInOneCellAreNotComparedOneByOne) {
  std::vector<MeshBorder> meshes(2);
  for (std::size_t m = 0; m < 2; ++m) {
    meshes[m].transforms = {glm::dmat4(1.0)};
    for (int i = 0; i < 100'000; ++i)
      meshes[m].places.emplace_back(1e-9F * static_cast<float>(i), 1e-6F * static_cast<float>(m), 0.0F);
    meshes[m].places.emplace_back(1.0F, static_cast<float>(m), 0.0F);
  }
  const auto touching = touchingPlaces(meshes);  // 10^10 comparisons would not end
  EXPECT_EQ(touching[0].size(), 100'000U);
  EXPECT_EQ(touching[1].size(), 100'000U);
}

TEST(SceneBudget, NothingOpensBetweenPlatesThatNodesMove) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  addMesh(model, test::grid(24));
  const asset::Primitive plate = test::grid(24);
  glm::vec3 low(1e9F);
  glm::vec3 high(-1e9F);
  for (const glm::vec3& p : plate.positions)
    low = glm::min(low, p), high = glm::max(high, p);
  tinygltf::Node beside = model.nodes[0];
  beside.translation = {high.x - low.x, 0.0, 0.0};
  model.nodes.push_back(beside);
  model.scenes[0].nodes.push_back(1);
  addMesh(model, test::sphere(24, 12));
  bakeIt(model, true, 0.1);
  const int lower = asset::lodNodes(model, 0).back();
  const tinygltf::Mesh& coarse =
      model.meshes[static_cast<std::size_t>(model.nodes[static_cast<std::size_t>(lower)].mesh)];
  std::size_t atSeam = 0;
  for (const glm::vec3& p : asset::readVec3(model, coarse.primitives[0].attributes.at("POSITION"), 1U << 20U))
    if (p.x == low.x || p.x == high.x) ++atSeam;
  EXPECT_EQ(atSeam, 50U) << "both seams keep all their vertices";
}

TEST(SceneBudget, ASmallMeshEndsInALevelThatShowsNothing) {
  tinygltf::Model model = scene();
  model.nodes[0].scale = {4.0, 4.0, 4.0};
  model.nodes[2].scale = {0.01, 0.01, 0.01};
  const tinygltf::Model before = model;
  const std::vector<MeshReport> reports = bakeIt(model, true, 0.01);
  ASSERT_EQ(reports.size(), 3U);
  EXPECT_FALSE(reports[0].endsInNothing);
  EXPECT_FALSE(reports[1].endsInNothing);
  ASSERT_TRUE(reports[2].endsInNothing);
  EXPECT_EQ(asset::emptyLevel(model, 1), -1);
  EXPECT_GE(asset::emptyLevel(model, 2), 0);
  const std::vector<float> coverage = asset::lodCoverage(model.nodes[2]);
  ASSERT_EQ(coverage.size(), reports[2].levels.size() + 1);
  EXPECT_EQ(coverage.back(), 0.0F);
  // Left out where its sphere covers less than a pixel of a 1920 x 1080 screen.
  EXPECT_NEAR(coverage[coverage.size() - 2], 3.14159265 / 4.0 / (1920.0 * 1080.0), 1e-12);
  tinygltf::Model alone = before;
  for (const MeshReport& report : bakeIt(alone, false, 0.01))
    EXPECT_FALSE(report.endsInNothing) << "each mesh has a budget of its own";
  tinygltf::Model held = before;
  BakeOptions options;
  options.chain.ratios = {0.01};
  options.chain.untilTriangles = 5;
  for (const MeshReport& report : bakeDocument(held, options, [](std::size_t, std::size_t, const std::string&) {}))
    EXPECT_FALSE(report.endsInNothing) << "no level may have fewer triangles";
}

/// The small sphere of scene(), at a hundredth of its size, after a change.
bool isLeftOut(const std::function<void(tinygltf::Model&)>& change) {
  tinygltf::Model model = scene();
  model.nodes[0].scale = {4.0, 4.0, 4.0};
  model.nodes[2].scale = {0.01, 0.01, 0.01};
  change(model);
  return bakeIt(model, true, 0.01)[2].endsInNothing;
}

TEST(SceneBudget, MeshesThatMayBeSeenAreNotLeftOut) {
  EXPECT_TRUE(isLeftOut([](tinygltf::Model&) {}));
  const auto instances = [](float scale) {
    return [scale](tinygltf::Model& model) {
      asset::Instances placed{{glm::vec3(0.0F), glm::vec3(3.0F)}, {}, {glm::vec3(1.0F), glm::vec3(scale)}};
      placed.rotations.assign(2, glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
      model.nodes[2].extensions["EXT_mesh_gpu_instancing"] = asset::appendInstances(model, placed);
    };
  };
  EXPECT_TRUE(isLeftOut(instances(2.0F)));
  EXPECT_FALSE(isLeftOut(instances(200.0F))) << "an instance is large";
  const auto animated = [](const char* path, int node) {
    return [path, node](tinygltf::Model& model) {
      model.animations.emplace_back().channels.emplace_back();
      model.animations[0].channels[0].target_node = node;
      model.animations[0].channels[0].target_path = path;
    };
  };
  EXPECT_FALSE(isLeftOut(animated("scale", 2)));
  EXPECT_TRUE(isLeftOut(animated("translation", 2)));
  EXPECT_FALSE(isLeftOut([&](tinygltf::Model& model) {
    tinygltf::Node parent;
    parent.children = {2};
    model.nodes.push_back(parent);
    std::replace(model.scenes[0].nodes.begin(), model.scenes[0].nodes.end(), 2, 3);
    animated("scale", 3)(model);
  })) << "a node above it grows";
  EXPECT_FALSE(isLeftOut([](tinygltf::Model& model) {
    tinygltf::Primitive points = model.meshes[2].primitives[0];
    points.mode = TINYGLTF_MODE_POINTS;
    model.meshes[2].primitives.push_back(points);
  })) << "points belong to every level";
}

TEST(SceneBudget, InstancesCountAsNodes) {
  const auto trianglesOf = [](bool instanced) {
    tinygltf::Model model = scene();
    std::vector<glm::vec3> places;
    for (int i = 0; i < 20; ++i)
      places.emplace_back(10.0F * static_cast<float>(i), 0.0F, 0.0F);
    if (instanced) {
      const asset::Instances placed{places, std::vector<glm::quat>(20, glm::quat(1.0F, 0.0F, 0.0F, 0.0F)),
                                    std::vector<glm::vec3>(20, glm::vec3(1.0F))};
      model.nodes[2].extensions["EXT_mesh_gpu_instancing"] = asset::appendInstances(model, placed);
    } else {
      for (int i = 1; i < 20; ++i) {
        model.nodes.push_back(model.nodes[2]);
        model.nodes.back().translation = {10.0 * i, 0.0, 0.0};
        model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()) - 1);
      }
    }
    const std::vector<MeshReport> reports = bakeIt(model, true, 0.25);
    return std::pair(reports[1].levels.back().triangles, reports[2].levels.back().triangles);
  };
  EXPECT_EQ(trianglesOf(true), trianglesOf(false));
}

TEST(SceneBudget, ErrorsReferToTheLargestMesh) {
  tinygltf::Model model = scene();
  BakeOptions options;
  options.chain.errors = {1.0};
  options.sceneBudget = true;
  const std::vector<MeshReport> reports =
      bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
  const double most = 0.01 * 4.0 * reports[1].diagonal;  // of the sphere with scale 4
  EXPECT_LE(4.0 * reports[1].levels.at(1).errorObject, most);
  EXPECT_GE(4.0 * reports[1].levels.at(1).errorObject, 0.7 * most);
  EXPECT_LE(0.1 * reports[2].levels.at(1).errorObject, most);
  EXPECT_LT(reports[2].levels.at(1).triangles, reports[1].levels.at(1).triangles / 10);
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
