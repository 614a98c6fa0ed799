// Cells of baked documents: the same triangles as without cells, in another order, and a table that fits.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

#include "asset/accessor.h"
#include "asset/lod_chain.h"
#include "asset/scene_file.h"
#include "bake/bake_fixtures.h"
#include "bake/io/bake_document.h"
#include "bake/io/level_cells.h"
#include "core/cell_tree.h"

namespace jalousie::bake {
namespace {

using Corner = std::array<float, 3>;
using Triangle = std::array<Corner, 3>;

/// One mesh of two spheres that overlap, each with a material of its own: 1520 and 960 triangles.
tinygltf::Model twoSpheres() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.materials.resize(2);
  tinygltf::Mesh mesh;
  mesh.name = "rock";
  mesh.primitives = {test::movedPrimitive(model, test::sphere(40, 20), glm::vec3(0)),
                     test::movedPrimitive(model, test::sphere(32, 16), glm::vec3(0.5F, 0, 0))};
  mesh.primitives[1].material = 1;
  test::showMesh(model, std::move(mesh));
  return model;
}

std::vector<MeshReport> bakeWith(tinygltf::Model& model, const CellOptions& cells, std::uint32_t levels = 5,
                                 asset::FaceGrouping faces = asset::FaceGrouping::kOff) {
  BakeOptions options;
  options.faces = faces;
  options.chain.levels = levels;
  options.chain.samples = 500;
  options.cells = cells;
  return bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
}

asset::SceneFile sceneWith(const CellOptions& cells) {
  tinygltf::Model model = twoSpheres();
  bakeWith(model, cells);
  return asset::readScene(asset::parseGltf(asset::encodeGlb(model), "baked.glb"), "baked.glb");
}

Triangle triangleAt(const asset::Primitive& primitive, std::size_t first) {
  Triangle triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec3& p = primitive.positions[primitive.indices[first + k]];
    triangle[k] = {p.x, p.y, p.z};
  }
  // From the least corner on, so that the side it faces still counts.
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

std::multiset<Triangle> trianglesOf(const asset::Primitive& primitive) {
  std::multiset<Triangle> triangles;
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3)
    triangles.insert(triangleAt(primitive, i));
  return triangles;
}

/// Centroids of all primitives, one primitive after the other, as divideIntoCells takes them.
std::vector<glm::vec3> centroidsOf(const asset::Mesh& mesh) {
  std::vector<glm::vec3> centroids;
  for (const asset::Primitive& primitive : mesh.primitives) {
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
      glm::dvec3 sum(0.0);
      for (std::size_t k = 0; k < 3; ++k)
        sum += glm::dvec3(primitive.positions[primitive.indices[i + k]]);
      centroids.emplace_back(sum / 3.0);
    }
  }
  return centroids;
}

/// Triangles of a cell, all primitives together.
std::uint32_t sizeOf(const asset::Mesh& mesh, std::size_t cell) {
  std::uint32_t size = 0;
  for (const asset::Primitive& primitive : mesh.primitives)
    size += (primitive.cellEnds[cell] - (cell == 0 ? 0 : primitive.cellEnds[cell - 1])) / 3;
  return size;
}

TEST(BakedCells, EveryTriangleOfTheUndividedBakeIsThereOnceAndNoOther) {
  const asset::SceneFile plain = sceneWith({0, true});
  const asset::SceneFile divided = sceneWith({64, false});
  ASSERT_EQ(divided.meshes.size(), 5U);
  ASSERT_EQ(plain.meshes.size(), 5U);
  bool differs = false;
  for (std::size_t m = 0; m < 5; ++m) {
    ASSERT_EQ(divided.meshes[m].primitives.size(), plain.meshes[m].primitives.size());
    for (std::size_t p = 0; p < plain.meshes[m].primitives.size(); ++p) {
      const asset::Primitive& a = plain.meshes[m].primitives[p];
      const asset::Primitive& b = divided.meshes[m].primitives[p];
      EXPECT_TRUE(a.cellEnds.empty());
      EXPECT_FALSE(b.cellEnds.empty());
      EXPECT_EQ(a.material, b.material);
      EXPECT_EQ(a.positions.size(), b.positions.size()) << "no vertex is doubled";
      EXPECT_EQ(trianglesOf(a), trianglesOf(b)) << m << " " << p;
      differs = differs || a.positions != b.positions;
    }
  }
  EXPECT_TRUE(differs) << "the order is another one";
}

TEST(BakedFaces, AreGroupsOfTheSameTrianglesWithinTheirCells) {
  for (const CellOptions& cells : {CellOptions{0, true}, CellOptions{256, false}}) {
    const asset::SceneFile plain = sceneWith(cells);
    for (const asset::FaceGrouping faces :
         {asset::FaceGrouping::kMasks, asset::FaceGrouping::kClusters, asset::FaceGrouping::kMeshlets}) {
      tinygltf::Model model = twoSpheres();
      model.materials[1].doubleSided = true;
      EXPECT_GT(bakeWith(model, cells, 5, faces).at(0).faceGroups, 10U);
      const std::vector<std::byte> file = asset::encodeGlb(model);
      tinygltf::Model again = twoSpheres();
      again.materials[1].doubleSided = true;
      bakeWith(again, cells, 5, faces);
      EXPECT_EQ(asset::encodeGlb(again), file) << "two bakes write the same bytes";
      const asset::SceneFile grouped = asset::readScene(asset::parseGltf(file, "baked.glb"), "baked.glb");
      for (std::size_t m = 0; m < 5; ++m) {
        for (std::size_t p = 0; p < plain.meshes[m].primitives.size(); ++p) {
          const asset::Primitive& a = plain.meshes[m].primitives[p];
          const asset::Primitive& b = grouped.meshes[m].primitives[p];
          EXPECT_TRUE(a.faceTree.empty());
          EXPECT_EQ(b.faceTree.empty(), b.material == 1) << "double-sided triangles are left whole";
          EXPECT_EQ(a.cellEnds, b.cellEnds);
          EXPECT_EQ(trianglesOf(a), trianglesOf(b)) << m << " " << p;
        }
      }
    }
  }
}

TEST(BakedCells, AreThoseOfTheTreeOverAllPrimitives) {
  constexpr std::uint32_t kMost = 64;
  const asset::SceneFile scene = sceneWith({kMost, false});
  const auto& levels = scene.chains.at(0).levels;
  const CellTree tree(centroidsOf(scene.meshes[levels[0].mesh]), kMost);
  EXPECT_GE(tree.cellCount(), 2480U / kMost);
  for (const asset::LodLevel& level : levels) {
    const asset::Mesh& mesh = scene.meshes[level.mesh];
    const std::vector<std::uint32_t> expected = tree.assign(centroidsOf(mesh));
    std::size_t triangle = 0;
    for (const asset::Primitive& primitive : mesh.primitives) {
      ASSERT_EQ(primitive.cellEnds.size(), tree.cellCount());
      std::uint32_t cell = 0;
      for (std::uint32_t i = 0; i < primitive.indices.size(); i += 3) {
        while (i >= primitive.cellEnds[cell])
          ++cell;
        ASSERT_EQ(cell, expected[triangle++]) << level.mesh;
      }
    }
    for (std::size_t cell = 0; cell < tree.cellCount(); ++cell)
      EXPECT_LE(sizeOf(mesh, cell), kMost);
  }
}

TEST(BakedCells, CoarseLevelsMergeThem) {
  const asset::SceneFile scene = sceneWith({64, false});
  std::size_t before = ~std::size_t{0};
  for (const asset::LodLevel& level : scene.chains.at(0).levels) {
    const asset::Mesh& mesh = scene.meshes[level.mesh];
    std::size_t filled = 0;
    for (std::size_t cell = 0; cell < mesh.primitives[0].cellEnds.size(); ++cell)
      filled += sizeOf(mesh, cell) > 0 ? 1U : 0U;
    EXPECT_LT(filled, before);
    before = filled;
  }
  EXPECT_LE(before, 6U) << "155 triangles need few cells of 64";
}

TEST(BakedCells, VerticesFollowTheirFirstUse) {
  const asset::SceneFile scene = sceneWith({64, false});
  for (const asset::Mesh& mesh : scene.meshes) {
    for (const asset::Primitive& primitive : mesh.primitives) {
      std::uint32_t next = 0;
      for (const std::uint32_t index : primitive.indices) {
        ASSERT_LE(index, next);
        next = std::max(next, index + 1);
      }
      EXPECT_EQ(next, primitive.positions.size());
    }
  }
}

TEST(BakedCells, KeepMostOfTheVertexCache) {
  const auto misses = [](const asset::SceneFile& scene) {
    const asset::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
    return meshopt_analyzeVertexCache(primitive.indices.data(), primitive.indices.size(), primitive.positions.size(),
                                      32, 32, 0)
        .acmr;
  };
  const float undivided = misses(sceneWith({0, true}));
  EXPECT_LT(misses(sceneWith({256, false})), 1.1F * undivided);
  EXPECT_LT(undivided, 0.9F);
}

TEST(BakedCells, AutoLeavesSmallMeshesAsTheyAre) {
  for (const std::uint32_t rows : {8U, 9U}) {  // 448 and 512 triangles
    tinygltf::Model model = twoSpheres();
    model.meshes[0].primitives = {test::movedPrimitive(model, test::sphere(32, rows), glm::vec3(0))};
    EXPECT_EQ(bakeWith(model, {})[0].cells, 0U);
    EXPECT_TRUE(asset::lodCells(model, model.meshes[0]).empty());
  }
  tinygltf::Model model = twoSpheres();
  model.meshes[0].primitives = {test::movedPrimitive(model, test::sphere(32, 10), glm::vec3(0))};
  EXPECT_EQ(bakeWith(model, {})[0].cells, 3U) << "576 triangles";
}

TEST(BakedCells, ManyPrimitivesGetLargerCells) {
  tinygltf::Model model = twoSpheres();
  model.meshes[0].primitives.clear();
  for (int i = 0; i < 100; ++i)
    model.meshes[0].primitives.push_back(test::movedPrimitive(model, test::sphere(8, 4), glm::vec3(3 * i, 0, 0)));
  const std::vector<MeshReport> reports = bakeWith(model, {64, false}, 2);
  const std::uint32_t triangles = 100 * 2 * 8 * 3;
  EXPECT_EQ(reports[0].cells, (triangles + 799) / 800) << "8 triangles for each primitive";
}

TEST(BakedCells, AnotherBakeReplacesThem) {
  tinygltf::Model model = twoSpheres();
  bakeWith(model, {64, false}, 1);  // one level: not a chain, so it is baked again
  EXPECT_GE(asset::cellCount(asset::lodCells(model, model.meshes[0])), 38U);
  tinygltf::Model other = asset::parseGltf(asset::encodeGlb(model), "once.glb");
  bakeWith(other, {500, false}, 3);
  EXPECT_EQ(asset::cellCount(asset::lodCells(other, other.meshes[0])), 5U);
  asset::parseGltf(asset::encodeGlb(other), "twice.glb");
  tinygltf::Model none = asset::parseGltf(asset::encodeGlb(model), "once.glb");
  bakeWith(none, {0, true}, 3);
  EXPECT_TRUE(asset::lodCells(none, none.meshes[0]).empty());
  EXPECT_FALSE(none.meshes[0].extras.Get("jalousie").Has("cells"));
}

TEST(BakedCells, LargeCoordinatesHaveCentroids) {
  CombinedMesh mesh;
  mesh.primitives.resize(1);
  for (int i = 0; i < 100; ++i) {
    for (const float z : {0.0F, 1e37F, 2e37F}) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.emplace_back(3e38F, 1e36F * static_cast<float>(i), z);  // three of these are more than a float
    }
  }
  const auto tree = divideIntoCells(mesh, {10, false});
  ASSERT_TRUE(tree.has_value());
  EXPECT_EQ(tree->cellCount(), 10U);
  const CellOrder order = orderByCells(mesh, tree);
  std::vector<std::uint32_t> expected(100);
  std::iota(expected.begin(), expected.end(), 0U);
  EXPECT_EQ(order.triangles, expected) << "along y";
  EXPECT_EQ(order.ends, (std::vector<std::uint32_t>{10, 20, 30, 40, 50, 60, 70, 80, 90, 100}));
}

TEST(BakedCells, TrianglesAtOnePlaceStayOneCell) {
  CombinedMesh mesh;
  mesh.primitives.resize(1);
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (int i = 0; i < 100; ++i)
    mesh.indices.insert(mesh.indices.end(), {0, 1, 2});
  EXPECT_FALSE(divideIntoCells(mesh, {10, false}).has_value());
}

}  // namespace
}  // namespace jalousie::bake
