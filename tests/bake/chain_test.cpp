// Laws of a chain over classes of meshes.
#include "bake/simplify/chain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bake/bake_fixtures.h"
#include "bake/mesh/clean.h"
#include "bake/mesh/normals.h"
#include "bake/mesh/subdivide.h"

namespace jalousie::bake {
namespace {

using test::combined;

ChainOptions quickOptions(Preset preset = Preset::kBest) {
  ChainOptions options;
  options.preset = preset;
  options.samples = 2000;
  return options;
}

void expectLaws(const LevelChain& chain) {
  ASSERT_FALSE(chain.levels.empty());
  EXPECT_FALSE(chain.stopReason.empty());
  EXPECT_EQ(chain.levels[0].errorMax, 0.0);
  for (std::size_t k = 0; k < chain.levels.size(); ++k) {
    const ChainLevel& level = chain.levels[k];
    EXPECT_EQ(level.mesh.corners.size() % 3, 0U);
    for (const std::uint32_t wedge : level.mesh.corners)
      ASSERT_LT(wedge, level.mesh.vertexOf.size());
    if (k == 0) continue;
    EXPECT_LT(level.mesh.triangles(), chain.levels[k - 1].mesh.triangles());
    EXPECT_GE(level.mesh.triangles(), kMinLevelTriangles);
    EXPECT_GE(level.errorMax, chain.levels[k - 1].errorMax);
    EXPECT_GE(level.errorMax, level.deviation.twoSided.max);
    EXPECT_LE(level.deviation.twoSided.mean, level.deviation.twoSided.max);
    EXPECT_LE(level.deviation.normalDegrees.mean, 180.0);
  }
}

class EveryPreset : public testing::TestWithParam<Preset> {};
INSTANTIATE_TEST_SUITE_P(Presets, EveryPreset, testing::Values(Preset::kBest, Preset::kFast, Preset::kDraft));

TEST_P(EveryPreset, ClosedMeshStaysClosedAtEveryLevel) {
  const LevelChain chain = makeChain(test::wedges(test::sphere(64, 32)), quickOptions(GetParam()));
  expectLaws(chain);
  EXPECT_GE(chain.levels.size(), 6U);
  for (const ChainLevel& level : chain.levels)
    EXPECT_TRUE(test::isClosed(level.mesh)) << level.mesh.triangles();
}

TEST_P(EveryPreset, CoarsestLevelHasExactlyTheAskedTriangles) {
  ChainOptions options = quickOptions(GetParam());
  options.levels = 6;
  options.coarsest = 98;
  const LevelChain chain = makeChain(test::wedges(test::sphere(64, 32)), options);
  expectLaws(chain);
  ASSERT_EQ(chain.levels.size(), 6U);
  EXPECT_EQ(chain.levels.back().mesh.triangles(), 98U);
}

TEST_P(EveryPreset, FlatShadedMeshReachesItsTargets) {
  const WedgeMesh mesh = test::wedges(test::flatShaded(test::sphere(48, 24)));
  const LevelChain chain = makeChain(mesh, quickOptions(GetParam()));
  expectLaws(chain);
  ASSERT_GE(chain.levels.size(), 6U);
  for (std::size_t k = 1; k < 6; ++k)
    EXPECT_LE(chain.levels[k].mesh.triangles(), (mesh.triangles() >> k) + 2);
}

TEST_P(EveryPreset, OpenNonManifoldAndTinyMeshesKeepTheLaws) {
  Random random(5);
  expectLaws(makeChain(test::wedges(test::perforatedWall(20, 0.4F, random)), quickOptions(GetParam())));
  asset::Primitive fan = test::sphere(16, 8);  // three sheets on one edge
  const auto n = static_cast<std::uint32_t>(fan.positions.size());
  fan.positions.insert(fan.positions.end(), {{2, 0, 0}, {2, 1, 0}, {2, 0, 1}});
  fan.normals.insert(fan.normals.end(), 3, glm::vec3(1, 0, 0));
  fan.indices.insert(fan.indices.end(), {0, 1, n, 0, 1, n + 1, 0, 1, n + 2});
  expectLaws(makeChain(test::wedges(fan), quickOptions(GetParam())));
  asset::Primitive one;
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.normals.assign(3, {0, 0, 1});
  one.indices = {0, 1, 2};
  const LevelChain single = makeChain(test::wedges(one), quickOptions(GetParam()));
  EXPECT_EQ(single.levels.size(), 1U);
  EXPECT_FALSE(single.stopReason.empty());
}

/// Random triangles on few points: every edge may be non-manifold, triangles overlap, some vertices share positions.
asset::Primitive soup(Random& random, std::uint32_t triangles, std::uint32_t points) {
  asset::Primitive mesh;
  for (std::uint32_t v = 0; v < points; ++v) {
    const bool same = v > 0 && random.below(4) == 0;
    mesh.positions.push_back(same ? mesh.positions[random.below(v)]
                                  : glm::vec3(random.uniform(), random.uniform(), 0.1F * random.uniform()));
    mesh.normals.push_back(glm::normalize(glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), 1.1F)));
    mesh.uvs.emplace_back(random.uniform(), random.uniform());
  }
  for (std::uint32_t t = 0; t < triangles; ++t)
    for (int k = 0; k < 3; ++k)
      mesh.indices.push_back(random.below(points));
  return mesh;
}

TEST_P(EveryPreset, TriangleSoupsKeepTheLaws) {
  Random random(17);
  for (int i = 0; i < 30; ++i) {
    CombinedMesh mesh = test::combinedTextured(soup(random, 20 + random.below(400), 6 + random.below(150)));
    cleanMesh(mesh);
    if (mesh.indices.empty()) continue;
    ChainOptions options = quickOptions(GetParam());
    options.samples = 200;
    options.untilError = 1e9;
    options.collapse.lockBorder = i % 3 == 0;
    expectLaws(makeChain(makeWedges(mesh), options));
  }
}

TEST(Chain, BestIsNearerThanDraftInDistanceAndNormals) {
  // A bumpy sphere: curvature everywhere, so that the order of collapses matters.
  asset::Primitive bumpy = test::sphere(96, 64);
  for (glm::vec3& p : bumpy.positions)
    p *= 1.0F + 0.1F * std::sin(7.0F * p.x) * std::sin(5.0F * p.y + 2.0F * p.z);
  bumpy.normals = smoothNormals(bumpy.positions, bumpy.indices);
  const WedgeMesh mesh = test::wedges(bumpy);
  const LevelChain best = makeChain(mesh, quickOptions(Preset::kBest));
  const LevelChain fast = makeChain(mesh, quickOptions(Preset::kFast));
  const LevelChain draft = makeChain(mesh, quickOptions(Preset::kDraft));
  for (std::size_t k = 1; k < 7; ++k) {
    const Deviation& reference = draft.levels.at(k).deviation;
    EXPECT_LT(best.levels.at(k).deviation.twoSided.mean, 0.8 * reference.twoSided.mean) << k;
    EXPECT_LT(best.levels.at(k).deviation.normalDegrees.mean, 0.9 * reference.normalDegrees.mean) << k;
    EXPECT_LT(fast.levels.at(k).deviation.twoSided.mean, (k < 3 ? 0.9 : 0.6) * reference.twoSided.mean) << k;
  }
}

TEST(Chain, StopsWithTheReason) {
  const WedgeMesh mesh = test::wedges(test::sphere(32, 16));
  ChainOptions options = quickOptions();
  options.untilTriangles = 200;
  LevelChain chain = makeChain(mesh, options);
  EXPECT_GE(chain.levels.back().mesh.triangles(), 200U);
  EXPECT_NE(chain.stopReason.find("fewer than 200"), std::string::npos);
  options.untilTriangles.reset();
  options.untilError = 1.0;
  chain = makeChain(mesh, options);
  EXPECT_GT(chain.levels.size(), 1U);
  const double diagonal = 2.0 * std::sqrt(3.0);
  EXPECT_LE(chain.levels.back().errorMax, 0.01 * diagonal);
  EXPECT_NE(chain.stopReason.find("% of the diagonal"), std::string::npos);
  options.untilError = 25.0;
  options.ratios = {0.6, 0.1};
  chain = makeChain(mesh, options);
  ASSERT_EQ(chain.levels.size(), 3U);
  EXPECT_NEAR(chain.levels[1].mesh.triangles(), 0.6 * mesh.triangles(), 2.0);
  EXPECT_NEAR(chain.levels[2].mesh.triangles(), 0.1 * mesh.triangles(), 2.0);
}

TEST_P(EveryPreset, ErrorsAreTargetsThatAreReachedAndNotExceeded) {
  const WedgeMesh mesh = test::wedges(test::sphere(64, 32));
  ChainOptions options = quickOptions(GetParam());
  options.errors = {0.2, 0.5, 2.0, 8.0};
  const double diagonal = 2.0 * std::sqrt(3.0);
  const LevelChain chain = makeChain(mesh, options);
  expectLaws(chain);
  EXPECT_EQ(chain.stopReason, "all levels made");
  ASSERT_EQ(chain.levels.size(), 5U);
  for (std::size_t k = 1; k < 5; ++k) {
    const double target = 0.01 * options.errors[k - 1] * diagonal;
    EXPECT_NEAR(chain.levels[k].target.value(), target, 1e-6);
    EXPECT_LE(chain.levels[k].errorMax, *chain.levels[k].target);
    EXPECT_GE(chain.levels[k].errorMax, 0.7 * target) << k;
  }
  // Nine tenths of the triangles exceed the target. A draft depends on the level that it starts from.
  for (std::size_t k = 1; k < 4 && GetParam() != Preset::kDraft; ++k) {
    ChainOptions fewer = quickOptions(GetParam());
    fewer.targets = {chain.levels[k].mesh.triangles() * 9 / 10};
    EXPECT_GT(makeChain(mesh, fewer).levels.at(1).errorMax, 0.01 * options.errors[k - 1] * diagonal) << k;
  }
  EXPECT_EQ(chain.levels[2].mesh.corners, makeChain(mesh, options).levels[2].mesh.corners);
}

TEST(Chain, ErrorsThatNoLevelReachesAreNamed) {
  ChainOptions options = quickOptions();
  options.errors = {1e-4, 2.0, 2.01};
  const LevelChain chain = makeChain(test::wedges(test::sphere(32, 16)), options);
  ASSERT_GE(chain.levels.size(), 2U);
  EXPECT_NEAR(chain.levels[1].target.value(), 0.02 * 2.0 * std::sqrt(3.0), 1e-6);
  EXPECT_NE(chain.stopReason.find("0.0001 %"), std::string::npos) << chain.stopReason;
  options.errors = {1.0};
  options.errorReserve = 1.0;  // more than the target
  EXPECT_EQ(makeChain(test::wedges(test::sphere(32, 16)), options).levels.size(), 1U);
}

TEST(Chain, PartsStayWhoseAbsenceWouldExceedTheTarget) {
  asset::Primitive two = test::sphere(48, 24);
  const asset::Primitive small = test::sphere(16, 8);
  const auto first = static_cast<std::uint32_t>(two.positions.size());
  for (const glm::vec3& p : small.positions)
    two.positions.push_back(0.01F * p + glm::vec3(1.5F, 0.0F, 0.0F));
  two.normals.insert(two.normals.end(), small.normals.begin(), small.normals.end());
  for (const std::uint32_t i : small.indices)
    two.indices.push_back(first + i);
  ChainOptions options = quickOptions();
  options.ratios = {0.02};
  const WedgeMesh mesh = test::wedges(two);
  EXPECT_EQ(makeChain(mesh, options).levels.at(1).removedParts, 1U);
  options.ratios.clear();
  options.errors = {2.0, 20.0};
  const LevelChain chain = makeChain(mesh, options);
  ASSERT_EQ(chain.levels.size(), 3U);
  EXPECT_EQ(chain.levels[1].removedParts, 0U);
  EXPECT_LT(chain.levels[1].mesh.triangles(), mesh.triangles() / 3);
  EXPECT_EQ(chain.levels[2].removedParts, 1U);
}

TEST(Chain, AStepTooFarEndsBeforeTheErrorThatIsAllowed) {
  // Four balls far apart: the level that was asked for would be without three of them.
  asset::Primitive balls;
  const asset::Primitive ball = test::sphere(16, 8);
  for (int i = 0; i < 4; ++i) {
    const auto first = static_cast<std::uint32_t>(balls.positions.size());
    for (const glm::vec3& p : ball.positions)
      balls.positions.push_back(0.1F * p + glm::vec3(static_cast<float>(i % 2) * 10.0F, 0.0F, i < 2 ? 0.0F : 10.0F));
    balls.normals.insert(balls.normals.end(), ball.normals.begin(), ball.normals.end());
    for (const std::uint32_t k : ball.indices)
      balls.indices.push_back(first + k);
  }
  ChainOptions options = quickOptions();
  options.ratios = {0.005};
  const WedgeMesh mesh = test::wedges(balls);
  const LevelChain chain = makeChain(mesh, options);
  expectLaws(chain);
  ASSERT_EQ(chain.levels.size(), 2U);
  EXPECT_EQ(chain.levels[1].removedParts, 0U);
  EXPECT_LT(chain.levels[1].mesh.triangles(), mesh.triangles() / 4);
  EXPECT_NE(chain.stopReason.find("would be off by"), std::string::npos);
}

TEST(Chain, CoverageDescendsToZeroAndFollowsTheTolerance) {
  const LevelChain chain = makeChain(test::wedges(test::sphere(64, 32)), quickOptions());
  const std::vector<float> coverage = screenCoverage(chain, 1.0);
  ASSERT_EQ(coverage.size(), chain.levels.size());
  EXPECT_LE(coverage.front(), 1.0F);
  EXPECT_EQ(coverage.back(), 0.0F);
  for (std::size_t k = 1; k < coverage.size(); ++k)
    EXPECT_LE(coverage[k], coverage[k - 1]);
  const std::vector<float> looser = screenCoverage(chain, 1.0, {2.0, 1080.0});
  EXPECT_NEAR(looser[3], 4.0F * coverage[3], 1e-4F * coverage[3]);  // twice the size on screen
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

TEST(Clean, TrianglesThatAreNowhereAreCounted) {
  asset::Primitive source = test::box(glm::vec3(1));
  const std::size_t kept = source.indices.size();
  source.positions.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
  source.positions.emplace_back(0.0F, std::numeric_limits<float>::infinity(), 0.0F);
  source.normals.insert(source.normals.end(), 2, glm::vec3(0, 1, 0));
  const auto n = static_cast<std::uint32_t>(source.positions.size());
  source.indices.insert(source.indices.end(), {0, 1, n - 2, 0, n - 1, 2});
  CombinedMesh mesh = combined(source);
  EXPECT_EQ(cleanMesh(mesh).notFinite, 2U);
  EXPECT_EQ(mesh.indices.size(), kept);
}

TEST(Subdivide, EachStepMakesFourTrianglesOfOneAndStaysClosed) {
  CombinedMesh mesh = combined(test::sphere(12, 6));
  const std::size_t before = mesh.indices.size();
  subdivideMesh(mesh, 2);
  EXPECT_EQ(mesh.indices.size(), before * 16);
  EXPECT_TRUE(test::isClosed(makeWedges(mesh)));
  for (const glm::vec3& p : mesh.positions)
    EXPECT_LE(glm::length(p), 1.0F + 1e-5F);  // Loop stays in the convex hull
}

TEST(Subdivide, AVertexMayHaveAnyNumberOfEdges) {
  for (const std::uint32_t around : {3U, 49U, 50U, 64U, 200U}) {
    CombinedMesh mesh = combined(test::sphere(around, 4));
    const double top = mesh.positions[0].y;
    glm::dvec3 ring(0.0);  // the mean of the neighbours of a pole lies on the axis
    for (const glm::vec3& p : mesh.positions)
      if (std::abs(std::abs(p.y) - std::cos(0.25F * 3.14159265F)) < 1e-3F && p.y * top > 0.0) ring.y = p.y;
    subdivideMesh(mesh, 1);
    // Loop's rule for a vertex with n neighbours (Loop 1987).
    const double n = around;
    const double bend = 3.0 + 2.0 * std::cos(2.0 * 3.14159265358979 / n);
    const double weight = (40.0 - bend * bend) / 64.0;
    double highest = -1e9;
    for (const glm::vec3& p : mesh.positions)
      highest = std::max(highest, double{p.y} * (top > 0.0 ? 1.0 : -1.0));
    EXPECT_NEAR(highest, std::abs((1.0 - weight) * top + weight * ring.y), 1e-5) << around;
  }
}

TEST(Subdivide, NonManifoldAndTexturedMeshesAreRefused) {
  asset::Primitive fan;
  fan.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  fan.normals.assign(5, {0, 1, 0});
  fan.indices = {0, 1, 2, 1, 0, 3, 0, 1, 4};
  CombinedMesh nonManifold = combined(fan);
  EXPECT_EQ(test::codeOf([&] { subdivideMesh(nonManifold, 1); }), ErrorCode::kUnsupported);
  CombinedMesh textured = combined(test::sphere(8, 4));
  textured.primitives[0].attributes.push_back({"TEXCOORD_0", 2, std::vector<float>(2 * textured.positions.size())});
  EXPECT_EQ(test::codeOf([&] { subdivideMesh(textured, 1); }), ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace jalousie::bake
