// Division of a scene's meshes into cells: no triangle is lost, boxes hold their triangles, and limits.
#include "scene/mesh_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "scene/scene_data.h"
#include "scene/scene_memory.h"
#include "support/error_code.h"
#include "support/scenes.h"

namespace jalousie::scene {
namespace {

using Kind = CellOptions::Kind;
using Triangle = std::array<std::uint32_t, 3>;

/// Triangles of one range as vertex numbers of the scene, sorted.
std::vector<Triangle> trianglesOf(const SceneData& scene, const gpu::Lod& lod) {
  std::vector<Triangle> triangles;
  for (std::uint32_t t = 0; t < lod.triangleCount; ++t) {
    Triangle triangle{};
    for (std::uint32_t k = 0; k < 3; ++k)
      triangle[k] = scene.indices[lod.firstIndex + 3 * t + k] + static_cast<std::uint32_t>(lod.baseVertex);
    triangles.push_back(triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// A chain of spheres and one of boxes with three kinds of surfaces; a few instances of each.
asset::SceneFile twoChains() {
  asset::SceneFile file = test::sphereChain(4);
  file.materials.resize(3, file.materials.front());
  file.materials[1].doubleSided = true;
  file.materials[2].alphaMode = asset::AlphaMode::kBlend;
  file.meshes.push_back({"mixed", {test::sphere(40, 20, 1), test::sphere(30, 20, 0), test::sphere(20, 12, 2)}});
  file.chains.push_back({"mixed", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  for (std::uint32_t i = 0; i < 7; ++i)
    test::addInstance(file, i % 2, {static_cast<float>(i), 0, 0}, glm::vec3(1.0F));
  return file;
}

TEST(MeshCells, CellsHoldEveryTriangleOnceAndKnowTheirBounds) {
  const asset::SceneFile file = twoChains();
  const SceneData whole = buildScene(file);
  const SceneData scene = buildScene(file, {.cells = {Kind::kCount, 64}});
  EXPECT_TRUE(whole.cells.objects.empty());
  ASSERT_FALSE(scene.cells.objects.empty());
  EXPECT_EQ(scene.indices.size(), whole.indices.size());
  EXPECT_EQ(scene.vertices.size(), whole.vertices.size());
  ASSERT_EQ(scene.objects.size(), whole.objects.size());
  std::size_t chain = 0;  // of the cells
  for (std::size_t c = 0; c < scene.chains.size(); ++c) {
    const gpu::Chain& objects = scene.chains[c];
    std::vector<std::vector<Triangle>> ofLevel(objects.lodCount);
    const std::size_t first = chain;
    for (; chain < scene.cells.chains.size(); ++chain) {
      const gpu::Chain& cell = scene.cells.chains[chain];
      const auto user = std::find_if(scene.cells.objects.begin(), scene.cells.objects.end(),
                                     [&](const gpu::Object& o) { return o.chain == chain; });
      ASSERT_NE(user, scene.cells.objects.end());
      if (scene.objects[user->object].chain != c) break;
      ASSERT_EQ(cell.lodCount, objects.lodCount);
      for (std::uint32_t k = 0; k < cell.lodCount; ++k) {
        const gpu::Lod& lod = scene.cells.lods[cell.firstLod + k];
        EXPECT_LE(lod.triangleCount, 64U);
        EXPECT_EQ(lod.errorObject, scene.lods[objects.firstLod + k].errorObject);
        const gpu::CellBounds& bounds = scene.cells.bounds[cell.firstLod + k];
        EXPECT_EQ(bounds.minObject.x > bounds.maxObject.x, lod.triangleCount == 0);
        for (const Triangle& triangle : trianglesOf(scene, lod)) {
          ofLevel[k].push_back(triangle);
          for (const std::uint32_t v : triangle) {
            EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::vec3(bounds.minObject), scene.vertices[v].position)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(scene.vertices[v].position, glm::vec3(bounds.maxObject))));
          }
        }
      }
    }
    EXPECT_GT(chain - first, 4U);
    for (std::uint32_t k = 0; k < objects.lodCount; ++k) {
      std::sort(ofLevel[k].begin(), ofLevel[k].end());
      EXPECT_EQ(ofLevel[k], trianglesOf(whole, whole.lods[whole.chains[c].firstLod + k]))
          << "chain " << c << " LOD " << k;
      EXPECT_EQ(ofLevel[k].size(), scene.lods[objects.firstLod + k].triangleCount);
    }
  }
  EXPECT_EQ(chain, scene.cells.chains.size());
}

TEST(MeshCells, CellsOfAChainLieTogetherInTheOrderOfTheirObjects) {
  const SceneData scene = buildScene(twoChains(), {.cells = {Kind::kCount, 64}});
  for (std::size_t i = 0; i < scene.cells.objects.size(); ++i) {
    const gpu::Object& cell = scene.cells.objects[i];
    const gpu::Object& object = scene.objects[cell.object];
    EXPECT_EQ(object.object, cell.object);
    EXPECT_EQ(cell.transform, object.transform);
    EXPECT_EQ(cell.owner, object.owner);
    if (i == 0) continue;
    const gpu::Object& before = scene.cells.objects[i - 1];
    EXPECT_TRUE(before.chain < cell.chain || (before.chain == cell.chain && before.object < cell.object));
  }
}

TEST(MeshCells, MirrorsTheFileWhereItSaysHow) {
  asset::SceneFile file = test::sphereChain(2);
  test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
  for (asset::Mesh& mesh : file.meshes) {
    const auto indices = static_cast<std::uint32_t>(mesh.primitives[0].indices.size());
    mesh.primitives[0].cellEnds = {indices / 6 * 3, indices, indices};
  }
  const SceneData scene = buildScene(file, {.cells = {Kind::kAutomatic}});
  ASSERT_EQ(scene.cells.chains.size(), 3U);
  EXPECT_EQ(scene.indices, buildScene(file).indices) << "the order of the file stays";
  const std::size_t finest = file.meshes[file.chains[0].levels[0].mesh].primitives[0].indices.size();
  EXPECT_EQ(scene.cells.lods[0].triangleCount, finest / 6);
  EXPECT_EQ(scene.cells.lods[2].triangleCount, finest / 3 - finest / 6);
  EXPECT_EQ(scene.cells.lods[4].triangleCount, 0U);
  EXPECT_EQ(buildScene(file, {.cells = {Kind::kCount, 50}}).cells.lods[0].triangleCount <= 50, true) << "cut anew";
  EXPECT_TRUE(buildScene(file).cells.objects.empty());
}

TEST(MeshCells, AutomaticJoinsTheCellsOfManyInstancesAndLeavesSmallMeshesWhole) {
  asset::SceneFile file = test::sphereChain(1);
  file.meshes[0].primitives[0] = test::sphere(64, 33);  // 4096 triangles: 16 cells
  test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
  const auto cellsWith = [&](std::uint64_t instances) {
    file.instances.resize(instances, file.instances[0]);
    return buildScene(file, {.cells = {Kind::kAutomatic}}).cells.chains.size();
  };
  EXPECT_EQ(cellsWith(1), 16U);
  EXPECT_EQ(cellsWith(kMostAutomaticCells / 16), 16U);
  EXPECT_EQ(cellsWith(kMostAutomaticCells / 16 + 1), 8U);
  EXPECT_EQ(cellsWith(kMostAutomaticCells / 2), 2U);
  EXPECT_EQ(cellsWith(kMostAutomaticCells / 2 + 1), 0U);
  file.instances.resize(1);
  file.meshes[0].primitives[0] = test::sphere(16, 17);  // 512 triangles: two cells would gain little
  EXPECT_TRUE(buildScene(file, {.cells = {Kind::kAutomatic}}).cells.objects.empty());
}

TEST(MeshCells, AutomaticJoinsNeighboursOfTheFileInEveryLevel) {
  asset::SceneFile file = test::sphereChain(2);
  for (asset::Mesh& mesh : file.meshes) {
    const auto triangles = static_cast<std::uint32_t>(mesh.primitives[0].indices.size() / 3);
    for (const std::uint32_t end : {5U, 5U, 9U, 20U, triangles})
      mesh.primitives[0].cellEnds.push_back(3 * end);
  }
  test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
  file.instances.resize(kMostAutomaticCells / 4, file.instances[0]);
  const std::vector<MeshCells> cells = divideMeshes(file, {Kind::kAutomatic});
  for (std::size_t m = 0; m < 2; ++m) {
    const auto end = static_cast<std::uint32_t>(file.meshes[m].primitives[0].indices.size());
    EXPECT_EQ(cells[m].count, 3U);
    EXPECT_EQ(cells[m].ends.at(0), (std::vector<std::uint32_t>{15, 60, end}));
    EXPECT_TRUE(cells[m].indices.at(0).empty());
  }
}

TEST(MeshCells, JoinedCellsDivideCoarseLevelsToo) {
  asset::SceneFile file = test::sphereChain(2);
  file.meshes[0].primitives[0] = test::sphere(64, 33);  // 4096 triangles
  file.meshes[1].primitives[0] = test::sphere(32, 17);  // 1024
  test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
  file.instances.resize(kMostAutomaticCells / 2, file.instances[0]);
  for (const MeshCells& level : divideMeshes(file, {Kind::kAutomatic})) {
    ASSERT_EQ(level.count, 2U);
    const std::vector<std::uint32_t>& ends = level.ends.at(0);
    EXPECT_GT(ends[0], ends[1] / 4);
    EXPECT_LT(ends[0], ends[1] * 3 / 4);
  }
}

TEST(MeshCells, ACrowdLeavesRoomForTheCellsOfOneLargeMesh) {
  asset::SceneFile file = test::sphereChain(1);
  file.meshes[0].primitives[0] = test::sphere(64, 33);
  file.meshes.push_back({"ground", {test::sphere(200, 101, 0)}});  // 40,000 triangles
  file.chains.push_back({"ground", {{1, 0.0F}}});
  test::addInstance(file, 1, glm::vec3(0.0F), glm::vec3(9.0F));
  const std::uint32_t alone = divideMeshes(file, {Kind::kAutomatic})[1].count;
  EXPECT_GT(alone, 150U);
  for (std::uint64_t i = 0; i < kMostAutomaticCells / 8; ++i)
    test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
  const std::vector<MeshCells> cells = divideMeshes(file, {Kind::kAutomatic});
  EXPECT_EQ(cells[1].count, alone);
  EXPECT_GE(cells[0].count, 4U);
  EXPECT_LE(cells[0].count, 7U) << "7 for each instance have room";
  file.instances.resize(1 + kMostAutomaticCells, file.instances.back());
  EXPECT_EQ(divideMeshes(file, {Kind::kAutomatic})[0].count, 1U);
  EXPECT_EQ(divideMeshes(file, {Kind::kAutomatic})[1].count, alone);
}

TEST(MeshCells, AMeshOfTwoChainsKeepsItsCellsOrHasNone) {
  asset::SceneFile file = test::sphereChain(2);
  for (asset::Mesh& mesh : file.meshes)
    for (const std::uint32_t end : {1U, 2U, 3U, static_cast<std::uint32_t>(mesh.primitives[0].indices.size() / 3)})
      mesh.primitives[0].cellEnds.push_back(3 * end);
  file.chains.push_back({"other", {file.chains[0].levels[0]}});
  test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
  test::addInstance(file, 1, glm::vec3(0.0F), glm::vec3(1.0F));
  EXPECT_EQ(divideMeshes(file, {Kind::kAutomatic})[1].count, 4U);
  file.instances.resize(kMostAutomaticCells / 4 + 1, file.instances[0]);
  EXPECT_EQ(divideMeshes(file, {Kind::kAutomatic})[1].count, 1U);
}

TEST(MeshCells, MoreCellsThanTheLimitAreRefused) {
  asset::SceneFile file = test::sphereChain(1);
  file.meshes[0].primitives[0] = test::sphere(64, 33);
  test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
  file.instances.resize(kMostCells / 64 + 1, file.instances[0]);
  EXPECT_EQ(test::codeOf([&] { divideMeshes(file, {Kind::kCount, 64}); }), ErrorCode::kLimit);
}

TEST(MeshCells, PositionsWhoseSumOverflowsAreDivided) {
  asset::SceneFile file = test::sphereChain(1);
  file.meshes[0].primitives[0] = test::sphere(64, 33);
  for (glm::vec3& position : file.meshes[0].primitives[0].positions)
    position *= 3e38F;
  test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
  const MeshCells cells = divideMeshes(file, {Kind::kCount, 256}).front();
  EXPECT_EQ(cells.count, 16U);
  EXPECT_EQ(cells.indices[0].size(), file.meshes[0].primitives[0].indices.size());
}

TEST(MeshCells, EstimateOfTheirNumberIsAnUpperBound) {
  const asset::SceneFile file = twoChains();
  const SceneData whole = buildScene(file);
  asset::SceneSize size = sizeOf(whole);
  for (const gpu::Chain& chain : whole.chains) {
    const std::uint64_t triangles = whole.lods[chain.firstLod].triangleCount;
    size.largestTriangles = std::max(size.largestTriangles, triangles);
    size.levelTriangles += triangles * chain.lodCount;
  }
  for (const gpu::Object& object : whole.objects)
    size.finestTriangles += whole.lods[whole.chains[object.chain].firstLod].triangleCount;
  for (const CellOptions& options : {CellOptions{Kind::kAutomatic}, {Kind::kCount, 64}, {Kind::kCount, 1024}}) {
    const asset::SceneSize bound = withCells(size, options);
    const SceneData built = buildScene(file, {.cells = options});
    EXPECT_GE(bound.cells, built.cells.objects.size());
    EXPECT_GE(bound.cellLevels, built.cells.lods.size());
    EXPECT_LE(bound.cells, 3 * built.cells.objects.size() + size.instances);
  }
  EXPECT_EQ(withCells(size, {}).cells, 0U);
  EXPECT_EQ(withCells(size, {Kind::kCount, 65536}).cells, 0U) << "nothing is so large";
}

TEST(MeshCells, AMeshOfTwoChainsStaysWhole) {
  asset::SceneFile file = test::sphereChain(3);
  file.chains.push_back({"other", {file.chains[0].levels[0]}});
  test::addInstance(file, 0, glm::vec3(0.0F), glm::vec3(1.0F));
  test::addInstance(file, 1, glm::vec3(3.0F), glm::vec3(1.0F));
  EXPECT_TRUE(buildScene(file, {.cells = {Kind::kCount, 16}}).cells.objects.empty());
}

}  // namespace
}  // namespace jalousie::scene
