// Inputs whose topology is not what it seems: bridges, back-to-back sheets, nearly welded vertices; locked borders and
// flat shading through a whole chain.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "bake/bake_fixtures.h"
#include "bake/mesh/back_sheets.h"
#include "bake/mesh/clean.h"
#include "bake/mesh/flat_shading.h"
#include "bake/mesh/normals.h"
#include "bake/mesh/weld.h"
#include "bake/simplify/chain.h"

namespace jalousie::bake {
namespace {

std::size_t countEdges(const WedgeMesh& mesh, EdgeKind kind) {
  std::size_t count = 0;
  for (const MeshEdge& edge : findEdges(mesh).edges)
    count += edge.kind == kind ? 1U : 0U;
  return count;
}

/// A bowl over the unit square.
asset::Primitive bowl(std::uint32_t n) {
  asset::Primitive mesh = test::grid(n);
  for (glm::vec3& p : mesh.positions)
    p.z = 0.3F * (p.x - 0.5F) * (p.x - 0.5F) + 0.2F * p.y * p.y;
  mesh.normals = smoothNormals(mesh.positions, mesh.indices);
  return mesh;
}

/// Two bowls of different resolution side by side, whose common line is closed by triangles without area.
CombinedMesh bridged() {
  asset::Primitive fine = bowl(8);
  asset::Primitive coarse = bowl(4);
  // The common line is straight, so that the bridges have no area at all.
  for (asset::Primitive* mesh : {&fine, &coarse})
    for (glm::vec3& p : mesh->positions)
      p.z = mesh == &fine ? 0.5F * p.x * p.x : -0.5F * p.x * p.x;
  for (glm::vec3& p : coarse.positions)
    p.x = -p.x;
  for (std::size_t t = 0; t < coarse.indices.size(); t += 3)
    std::swap(coarse.indices[t + 1], coarse.indices[t + 2]);
  const auto first = static_cast<std::uint32_t>(fine.positions.size());
  fine.positions.insert(fine.positions.end(), coarse.positions.begin(), coarse.positions.end());
  for (const std::uint32_t index : coarse.indices)
    fine.indices.push_back(first + index);
  for (std::uint32_t y = 0; y < 4; ++y) {  // a long edge of the coarse bowl, and the middle vertex of the fine one
    const std::uint32_t low = 9 * (2 * y);
    fine.indices.insert(fine.indices.end(), {low, low + 9, low + 18});
  }
  fine.normals = smoothNormals(fine.positions, fine.indices);
  return test::combined(fine);
}

TEST(Bridges, HoldTheMeshTogetherAtEveryLevel) {
  CombinedMesh mesh = bridged();
  const std::size_t before = mesh.indices.size();
  const CleanCounts counts = cleanMesh(mesh);
  EXPECT_EQ(counts.bridges, 4U);
  EXPECT_EQ(counts.degenerate, 0U);
  EXPECT_EQ(mesh.indices.size(), before);
  const WedgeMesh whole = makeWedges(mesh);
  EXPECT_EQ(countEdges(whole, EdgeKind::kBorder), 3U * 8 + 3U * 4);  // none along the common line
  ChainOptions options;
  options.ratios = {0.5, 0.2};
  const LevelChain chain = makeChain(whole, options);
  ASSERT_EQ(chain.levels.size(), 3U);
  for (std::size_t k = 1; k < 3; ++k) {
    for (const MeshEdge& edge : findEdges(chain.levels[k].mesh).edges) {
      if (edge.kind != EdgeKind::kBorder) continue;
      const glm::vec3 a = chain.levels[k].mesh.positions[edge.a];
      const glm::vec3 b = chain.levels[k].mesh.positions[edge.b];
      const float y = 0.5F * (a.y + b.y);
      EXPECT_FALSE(std::abs(0.5F * (a.x + b.x)) < 0.2F && y > 0.1F && y < 0.9F) << "a slit at level " << k;
    }
  }
}

TEST(Bridges, TrianglesWithoutAreaThatJoinNothingGo) {
  asset::Primitive mesh = test::grid(2);
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{5, 0, 0}, {6, 0, 0}, {7, 0, 0}});
  mesh.normals.insert(mesh.normals.end(), 3, glm::vec3(0, 0, 1));
  mesh.indices.insert(mesh.indices.end(), {n, n + 1, n + 2});
  CombinedMesh combined = test::combined(mesh);
  const CleanCounts counts = cleanMesh(combined);
  EXPECT_EQ(counts.degenerate, 1U);
  EXPECT_EQ(counts.bridges, 0U);
}

/// A surface with a reversed copy of every triangle on vertices of its own.
asset::Primitive backToBack(const asset::Primitive& front) {
  asset::Primitive mesh = front;
  const auto n = static_cast<std::uint32_t>(front.positions.size());
  mesh.positions.insert(mesh.positions.end(), front.positions.begin(), front.positions.end());
  for (const glm::vec3& normal : front.normals)
    mesh.normals.push_back(-normal);
  for (std::size_t t = 0; t < front.indices.size(); t += 3)
    mesh.indices.insert(mesh.indices.end(), {n + front.indices[t], n + front.indices[t + 2], n + front.indices[t + 1]});
  return mesh;
}

TEST(BackSheets, KeepTheirBorders) {
  const WedgeMesh mesh = test::wedges(backToBack(bowl(30)));
  EXPECT_EQ(countEdges(mesh, EdgeKind::kNonManifold), 0U);
  EXPECT_EQ(countEdges(mesh, EdgeKind::kBorder), 240U);
  ChainOptions options;
  options.ratios = {0.25, 0.06};
  const LevelChain chain = makeChain(mesh, options);
  ASSERT_EQ(chain.levels.size(), 3U);
  EXPECT_LT(chain.levels[1].errorMax, 0.003);  // 0.2 % of the diagonal
  EXPECT_LT(chain.levels[2].errorMax, 0.012);
}

TEST(BackSheets, BelongToSurfacesThatHaveNothingElse) {
  // A fin that is attached to a wall: its back sheet is not cut off from the wall.
  asset::Primitive mesh = backToBack(test::grid(2));
  const WedgeMesh free = test::wedges(mesh);
  EXPECT_EQ(findBackSheets(vertexIndices(test::wedges(test::grid(2)))).size(), 0U);
  EXPECT_EQ(free.positions.size(), 18U);
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {0, 0.5, 0}, {0, 0, 1}});
  mesh.normals.insert(mesh.normals.end(), 3, glm::vec3(1, 0, 0));
  mesh.indices.insert(mesh.indices.end(), {n, n + 1, n + 2});
  EXPECT_EQ(test::wedges(mesh).positions.size(), 10U);
}

TEST(Weld, SnapsToTheFirstPositionWithinTheDistance) {
  std::vector<glm::vec3> positions = {{0, 0, 0}, {0.9e-3, 0, 0}, {1.8e-3, 0, 0}, {5, 5, 5}, {5, 5, 5.0005}, {-1, 0, 0}};
  EXPECT_EQ(snapPositions(positions, 1e-3), 2U);
  EXPECT_EQ(positions[1], positions[0]);
  EXPECT_NE(positions[2], positions[0]);  // too far from the first, and the second has moved
  EXPECT_EQ(positions[4], positions[3]);
  EXPECT_EQ(snapPositions(positions, 0.0), 0U);
}

TEST(Weld, JoinsAMeshOfLooseTriangles) {
  asset::Primitive mesh = test::flatShaded(test::sphere(32, 16));
  Random random(2);
  for (glm::vec3& p : mesh.positions)
    p += 1e-6F * glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  EXPECT_GT(countEdges(test::wedges(mesh), EdgeKind::kBorder), 1000U);
  snapPositions(mesh.positions, 1e-5);
  EXPECT_EQ(countEdges(test::wedges(mesh), EdgeKind::kBorder), 0U);
}

TEST(Weld, VerticesThatBecameEqualAreShared) {
  const asset::Primitive sphere = test::sphere(16, 8);
  asset::Primitive loose;  // every triangle with vertices of its own and smooth normals
  for (const std::uint32_t index : sphere.indices) {
    loose.indices.push_back(static_cast<std::uint32_t>(loose.positions.size()));
    loose.positions.push_back(sphere.positions[index]);
    loose.normals.push_back(sphere.normals[index]);
  }
  CombinedMesh mesh = test::combined(loose);
  mesh.positions[0].x += 1e-6F;
  snapPositions(mesh.positions, 1e-5);
  shareEqualVertices(mesh);
  const WedgeMesh wedges = makeWedges(mesh);
  EXPECT_EQ(countEdges(wedges, EdgeKind::kBorder), 0U);
  EXPECT_LT(wedges.vertexOf.size(), sphere.positions.size() + 20);
}

class EveryCollapse : public testing::TestWithParam<Preset> {};
INSTANTIATE_TEST_SUITE_P(Presets, EveryCollapse, testing::Values(Preset::kBest, Preset::kFast, Preset::kDraft));

TEST_P(EveryCollapse, LockedBordersKeepTheirAttributes) {
  const WedgeMesh mesh = makeWedges(test::combinedTextured(bowl(24)));
  ChainOptions options;
  options.preset = GetParam();
  options.collapse.lockBorder = true;
  options.ratios = {0.5, 0.25};
  const LevelChain chain = makeChain(mesh, options);
  ASSERT_EQ(chain.levels.size(), 3U);
  std::map<std::array<float, 3>, std::uint32_t> wedgeAt;
  for (std::uint32_t w = 0; w < mesh.vertexOf.size(); ++w) {
    const glm::vec3 p = mesh.positions[mesh.vertexOf[w]];
    wedgeAt[{p.x, p.y, p.z}] = w;
  }
  for (std::size_t k = 1; k < 3; ++k) {
    const WedgeMesh& level = chain.levels[k].mesh;
    std::size_t border = 0;
    for (std::uint32_t w = 0; w < level.vertexOf.size(); ++w) {
      const glm::vec3 p = level.positions[level.vertexOf[w]];
      if (p.x != 0.0F && p.x != 1.0F && p.y != 0.0F && p.y != 1.0F) continue;
      ++border;
      const auto found = wedgeAt.find({p.x, p.y, p.z});
      ASSERT_NE(found, wedgeAt.end());
      for (std::uint32_t i = 0; i < mesh.stride; ++i)
        EXPECT_EQ(level.attributes[std::size_t{w} * level.stride + i],
                  mesh.attributes[std::size_t{found->second} * mesh.stride + i]);
    }
    EXPECT_EQ(border, 96U);
  }
}

TEST_P(EveryCollapse, FlatShadingStaysFlat) {
  ChainOptions options;
  options.preset = GetParam();
  options.ratios = {0.5, 0.1};
  const LevelChain chain = makeChain(test::wedges(test::flatShaded(test::sphere(48, 24))), options);
  ASSERT_EQ(chain.levels.size(), 3U);
  for (const ChainLevel& level : chain.levels) {
    const AttributeSlot& normals = *level.mesh.slot("NORMAL");
    for (std::size_t c = 0; c < level.mesh.corners.size(); ++c) {
      const std::size_t t = c / 3 * 3;
      const glm::dvec3 face =
          faceNormal(level.mesh.positions[level.mesh.vertexAt(t)], level.mesh.positions[level.mesh.vertexAt(t + 1)],
                     level.mesh.positions[level.mesh.vertexAt(t + 2)]);
      ASSERT_GT(glm::dot(face, glm::dvec3(level.mesh.vec3At(level.mesh.corners[c], normals))), 0.9998);
    }
  }
}

TEST(FlatShading, IsNotSeenInSmoothOrPlaneMeshes) {
  EXPECT_TRUE(flatPrimitives(test::wedges(test::sphere(32, 16))).empty());
  EXPECT_TRUE(flatPrimitives(test::wedges(test::grid(8))).empty());
  EXPECT_EQ(flatPrimitives(test::wedges(test::flatShaded(test::sphere(32, 16)))), std::vector<bool>{true});
}

}  // namespace
}  // namespace jalousie::bake
