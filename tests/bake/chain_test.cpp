// Laws of a chain over classes of meshes.
#include "bake/chain.h"

#include <gtest/gtest.h>

#include <map>

#include "bake/bake_fixtures.h"
#include "bake/clean.h"
#include "bake/subdivide.h"
#include "bake/triangle_mesh.h"

namespace jalousie::bake {
namespace {

using test::combined;

ChainOptions fastOptions() {
  ChainOptions options;
  options.samples = 2000;
  return options;
}

void expectLaws(const CombinedMesh& mesh, const LevelChain& chain) {
  ASSERT_FALSE(chain.levels.empty());
  EXPECT_FALSE(chain.stopReason.empty());
  EXPECT_EQ(chain.levels[0].errorMax, 0.0);
  for (std::size_t k = 0; k < chain.levels.size(); ++k) {
    const ChainLevel& level = chain.levels[k];
    EXPECT_EQ(level.indices.size() % 3, 0U);
    for (const std::uint32_t index : level.indices)
      ASSERT_LT(index, mesh.positions.size());
    if (k == 0) continue;
    EXPECT_LT(level.triangles(), chain.levels[k - 1].triangles());
    EXPECT_GE(level.triangles(), kMinLevelTriangles);
    EXPECT_GE(level.errorMax, chain.levels[k - 1].errorMax);
    EXPECT_LE(level.errorMean, level.errorMax);
  }
}

/// Every edge of a closed, consistently wound mesh is used once in each direction.
bool isClosed(const CombinedMesh& mesh, const std::vector<std::uint32_t>& indices) {
  const std::vector<std::uint32_t> ids = weldByPosition(mesh.positions);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t t = 0; t < indices.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k)
      ++edges[{ids[indices[t + k]], ids[indices[t + (k + 1) % 3]]}];
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || back->second != 1) return false;
  }
  return true;
}

TEST(Chain, ClosedMeshStaysClosedAtEveryLevel) {
  const CombinedMesh mesh = combined(test::sphere(64, 32));
  const LevelChain chain = makeChain(mesh, fastOptions());
  expectLaws(mesh, chain);
  EXPECT_GE(chain.levels.size(), 6U);
  for (const ChainLevel& level : chain.levels)
    EXPECT_TRUE(isClosed(mesh, level.indices)) << level.triangles();
}

TEST(Chain, CoarsestLevelHasExactlyTheAskedTriangles) {
  const CombinedMesh mesh = combined(test::sphere(64, 32));
  ChainOptions options = fastOptions();
  options.levels = 6;
  options.coarsest = 98;
  const LevelChain chain = makeChain(mesh, options);
  expectLaws(mesh, chain);
  ASSERT_EQ(chain.levels.size(), 6U);
  EXPECT_EQ(chain.levels.back().triangles(), 98U);
}

TEST(Chain, FlatShadedMeshIsSimplifiedToo) {
  const CombinedMesh mesh = combined(test::flatShaded(test::sphere(48, 24)));
  const LevelChain chain = makeChain(mesh, fastOptions());
  expectLaws(mesh, chain);
  EXPECT_LT(chain.levels.back().triangles(), mesh.indices.size() / 3 / 16);
}

TEST(Chain, OpenNonManifoldAndTinyMeshesKeepTheLaws) {
  Random random(5);
  const CombinedMesh open = combined(test::perforatedWall(20, 0.4F, random));
  expectLaws(open, makeChain(open, fastOptions()));
  asset::Primitive fan = test::sphere(16, 8);  // three sheets on one edge
  const auto n = static_cast<std::uint32_t>(fan.positions.size());
  fan.positions.insert(fan.positions.end(), {{2, 0, 0}, {2, 1, 0}, {2, 0, 1}});
  fan.normals.insert(fan.normals.end(), 3, glm::vec3(1, 0, 0));
  fan.indices.insert(fan.indices.end(), {0, 1, n, 0, 1, n + 1, 0, 1, n + 2});
  const CombinedMesh nonManifold = combined(fan);
  expectLaws(nonManifold, makeChain(nonManifold, fastOptions()));
  asset::Primitive one;
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.normals.assign(3, {0, 0, 1});
  one.indices = {0, 1, 2};
  const LevelChain single = makeChain(combined(one), fastOptions());
  EXPECT_EQ(single.levels.size(), 1U);
  EXPECT_FALSE(single.stopReason.empty());
}

TEST(Chain, CoverageDescendsToZero) {
  const CombinedMesh mesh = combined(test::sphere(64, 32));
  const LevelChain chain = makeChain(mesh, fastOptions());
  const std::vector<float> coverage = screenCoverage(chain, 1.0);
  ASSERT_EQ(coverage.size(), chain.levels.size());
  EXPECT_LE(coverage.front(), 1.0F);
  EXPECT_EQ(coverage.back(), 0.0F);
  for (std::size_t k = 1; k < coverage.size(); ++k)
    EXPECT_LE(coverage[k], coverage[k - 1]);
}

TEST(Clean, DegenerateAndDuplicateTrianglesGoTheRestKeepsItsOrder) {
  asset::Primitive source = test::box(glm::vec3(1));
  const std::vector<std::uint32_t> kept = source.indices;
  source.indices.insert(source.indices.end(), {0, 0, 1});                    // two equal corners
  source.indices.insert(source.indices.end(), {kept[1], kept[2], kept[0]});  // the first, rotated
  CombinedMesh mesh = combined(source);
  const CleanCounts counts = cleanMesh(mesh);
  EXPECT_EQ(counts.degenerate, 1U);
  EXPECT_EQ(counts.duplicate, 1U);
  EXPECT_EQ(mesh.indices, kept);
}

TEST(Subdivide, EachStepMakesFourTrianglesOfOneAndStaysClosed) {
  CombinedMesh mesh = combined(test::sphere(12, 6));
  const std::size_t before = mesh.indices.size();
  subdivideMesh(mesh, 2);
  EXPECT_EQ(mesh.indices.size(), before * 16);
  EXPECT_TRUE(isClosed(mesh, mesh.indices));
  for (const glm::vec3& p : mesh.positions)
    EXPECT_LE(glm::length(p), 1.0F + 1e-5F);  // Loop stays in the convex hull
}

TEST(Subdivide, NonManifoldAndTexturedMeshesAreRefused) {
  asset::Primitive fan;
  fan.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  fan.normals.assign(5, {0, 1, 0});
  fan.indices = {0, 1, 2, 1, 0, 3, 0, 1, 4};
  CombinedMesh nonManifold = combined(fan);
  EXPECT_EQ(test::bakeErrorOf([&] { subdivideMesh(nonManifold, 1); }), ErrorCode::kUnsupported);
  CombinedMesh textured = combined(test::sphere(8, 4));
  textured.primitives[0].attributes.push_back({"TEXCOORD_0", 2, std::vector<float>(2 * textured.positions.size())});
  EXPECT_EQ(test::bakeErrorOf([&] { subdivideMesh(textured, 1); }), ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace jalousie::bake
