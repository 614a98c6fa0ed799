// Boxes inside of closed meshes: against random points, at every level, through the baker, and what has none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "asset/accessor.h"
#include "asset/gltf_quantize.h"
#include "asset/mesh_occluders.h"
#include "asset/scene_file.h"
#include "bake/bake_fixtures.h"
#include "bake/io/bake_document.h"
#include "bake/io/bake_occluders.h"
#include "bake/mesh/facets.h"
#include "bake/mesh/inner_boxes.h"
#include "bake/report/inspect.h"

namespace jalousie::bake {
namespace {

LevelSurface surfaceOf(const asset::Primitive& primitive, const glm::vec3& offset = glm::vec3(0.0F)) {
  LevelSurface surface{primitive.positions, primitive.indices};
  for (glm::vec3& position : surface.positions)
    position += offset;
  return surface;
}

void append(LevelSurface& surface, const LevelSurface& more) {
  const auto first = static_cast<std::uint32_t>(surface.positions.size());
  surface.positions.insert(surface.positions.end(), more.positions.begin(), more.positions.end());
  for (const std::uint32_t index : more.indices)
    surface.indices.push_back(first + index);
}

/// A ball with the same places at its seam, so that it is closed bit for bit.
LevelSurface ball(std::uint32_t segments, float radius = 1.0F) {
  LevelSurface surface = surfaceOf(test::sphere(segments, segments / 2));
  for (glm::vec3& position : surface.positions)
    position = radius * glm::round(position * 4096.0F) / 4096.0F;
  return surface;
}

std::vector<Aabb> boxesIn(const LevelSurface& surface, const InnerBoxOptions& options = {}) {
  return innerBoxes(std::span(&surface, 1), options);
}

double volumeOf(const Aabb& box) {
  return double{box.extent().x} * double{box.extent().y} * double{box.extent().z};
}

TEST(InnerBoxes, ABoxIsFilledAlmostCompletely) {
  const LevelSurface surface = surfaceOf(test::box({1.0F, 2.0F, 0.5F}), {3, 4, 5});
  ASSERT_TRUE(isClosed(surface));
  const std::vector<Aabb> boxes = boxesIn(surface);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_GT(volumeOf(boxes[0]), 0.98 * 8.0);
  EXPECT_LT(volumeOf(boxes[0]), 8.0);
}

TEST(InnerBoxes, NoTriangleOfAnyLevelComesNearAndEachLevelIsAround) {
  const std::vector<LevelSurface> levels = {ball(48), ball(16), ball(8, 0.9F)};
  const std::vector<Aabb> boxes = innerBoxes(levels);
  ASSERT_GE(boxes.size(), 1U);
  EXPECT_GT(volumeOf(boxes[0]), 0.5 * std::pow(2.0 * 0.9 * 0.85 / std::sqrt(3.0), 3.0));
  Random random(1);
  for (const Aabb& box : boxes) {
    EXPECT_TRUE(liesInside(box, levels));
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 point(random.uniform(box.min.x, box.max.x), random.uniform(box.min.y, box.max.y),
                             random.uniform(box.min.z, box.max.z));
      for (const LevelSurface& level : levels)
        EXPECT_NEAR(windingNumber(level, point), 1.0, 1e-6);
    }
  }
  EXPECT_FALSE(liesInside({glm::vec3(-0.7F), glm::vec3(0.7F)}, levels)) << "the corners stand out";
  EXPECT_FALSE(liesInside({glm::vec3(2.0F), glm::vec3(3.0F)}, levels));
}

TEST(InnerBoxes, AnLHasOneBoxInEachWing) {
  // Six corners in the plane, two high.
  LevelSurface surface;
  const glm::vec2 outline[] = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  for (const float y : {0.0F, 2.0F})
    for (const glm::vec2& p : outline)
      surface.positions.emplace_back(p.x, y, p.y);
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t next = (i + 1) % 6;
    surface.indices.insert(surface.indices.end(), {i, i + 6, next + 6, i, next + 6, next});
  }
  for (const auto& [a, b, c] : {std::tuple{0U, 1U, 3U}, {1U, 2U, 3U}, {0U, 3U, 5U}, {3U, 4U, 5U}}) {
    surface.indices.insert(surface.indices.end(), {a, b, c, a + 6, c + 6, b + 6});
  }
  ASSERT_TRUE(isClosed(surface));
  ASSERT_NEAR(windingNumber(surface, {0.5, 1.0, 0.5}), 1.0, 1e-9);
  const std::vector<Aabb> boxes = boxesIn(surface);
  ASSERT_GE(boxes.size(), 2U);
  EXPECT_GT(volumeOf(boxes[0]), 7.0);
  EXPECT_GT(volumeOf(boxes[1]), 5.0);
  for (const Aabb& box : boxes)
    EXPECT_TRUE(box.max.x < 1.0F || box.max.z < 1.0F);
}

TEST(InnerBoxes, WhatIsInsideOutOrAHollowHasNone) {
  LevelSurface inverted = surfaceOf(test::box(glm::vec3(1.0F)));
  for (std::size_t i = 0; i < inverted.indices.size(); i += 3)
    std::swap(inverted.indices[i], inverted.indices[i + 1]);
  ASSERT_TRUE(isClosed(inverted));
  EXPECT_TRUE(boxesIn(inverted).empty()) << "single-sided triangles that face inwards are not drawn";
  EXPECT_EQ(boxesIn(inverted, {.insideOut = true}).size(), 1U);
  LevelSurface room = surfaceOf(test::box(glm::vec3(1.0F)));
  LevelSurface hollow = surfaceOf(test::box(glm::vec3(0.95F)));
  for (std::size_t i = 0; i < hollow.indices.size(); i += 3)
    std::swap(hollow.indices[i], hollow.indices[i + 1]);
  append(room, hollow);
  EXPECT_NEAR(windingNumber(room, {0.1, 0.2, 0.3}), 0.0, 1e-9);
  EXPECT_TRUE(boxesIn(room).empty()) << "an eye in the room sees the room";
}

TEST(InnerBoxes, AMissingTriangleOpensASurface) {
  LevelSurface surface = ball(16);
  ASSERT_TRUE(isClosed(surface));
  surface.indices.resize(surface.indices.size() - 3);
  EXPECT_FALSE(isClosed(surface));
  EXPECT_FALSE(isClosed({}));
}

TEST(InnerBoxes, TouchingAgreesWithPointsOfTheTriangle) {
  Random random(2);
  const auto point = [&](double reach) {
    return reach * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 triangle[3] = {point(2.0), point(2.0), point(2.0)};
    const glm::dvec3 center = point(1.0);
    const glm::dvec3 half = glm::abs(point(0.7)) + 0.05;
    bool inside = false;
    for (int k = 0; k < 300 && !inside; ++k) {
      double a = double{random.uniform()};
      double b = double{random.uniform()};
      if (a + b > 1.0) {
        a = 1.0 - a;
        b = 1.0 - b;
      }
      const glm::dvec3 at = triangle[0] + a * (triangle[1] - triangle[0]) + b * (triangle[2] - triangle[0]);
      inside = glm::all(glm::lessThanEqual(glm::abs(at - center), half));
    }
    EXPECT_TRUE(!inside || touches(triangle, center, half));
    touching += touches(triangle, center, half) ? 1 : 0;
  }
  EXPECT_GT(touching, 500);
  EXPECT_LT(touching, 2500);
}

std::vector<Facet> facetsOf(const LevelSurface& surface, bool bothSides = false) {
  const std::vector<std::uint8_t> sides(surface.indices.size() / 3, bothSides ? 1 : 0);
  return largeFacets(surface, sides);
}

/// Triangles of a wall of n x n squares of side 1 in the plane y = 2, facing +y; some squares are left out.
LevelSurface wall(std::uint32_t n, const std::function<bool(std::uint32_t, std::uint32_t)>& isOpen) {
  LevelSurface surface;
  for (std::uint32_t z = 0; z <= n; ++z)
    for (std::uint32_t x = 0; x <= n; ++x)
      surface.positions.emplace_back(x, 2.0F, z);
  for (std::uint32_t z = 0; z < n; ++z) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = z * (n + 1) + x;
      if (!isOpen(x, z))
        surface.indices.insert(surface.indices.end(), {a, a + n + 1, a + 1, a + 1, a + n + 1, a + n + 2});
    }
  }
  return surface;
}

TEST(Facets, AWallIsCoveredAlmostCompletely) {
  const std::vector<Facet> facets = facetsOf(wall(10, [](auto, auto) { return false; }), true);
  ASSERT_EQ(facets.size(), 1U);
  EXPECT_GT(facets[0].area, 90.0);
  EXPECT_LE(facets[0].area, 100.0);
  EXPECT_TRUE(facets[0].bothSides);
  const glm::vec3 normal =
      glm::cross(facets[0].corners[1] - facets[0].corners[0], facets[0].corners[2] - facets[0].corners[0]);
  EXPECT_GT(normal.y, 0.0F);
  for (const glm::vec3& corner : facets[0].corners)
    EXPECT_NEAR(corner.y, 2.0F, 1e-5F);
}

TEST(Facets, NoRectangleHoldsAHole) {
  Random random(3);
  int found = 0;
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<bool> open(144);
    for (std::size_t cell = 0; cell < open.size(); ++cell)
      open[cell] = random.below(12) == 0;
    const LevelSurface surface = wall(12, [&](std::uint32_t x, std::uint32_t z) { return open[z * 12 + x]; });
    for (const Facet& facet : facetsOf(surface)) {
      ++found;
      for (int i = 0; i < 400; ++i) {
        const float u = random.uniform();
        const float v = random.uniform();
        const glm::vec3 point =
            facet.corners[0] + u * (facet.corners[1] - facet.corners[0]) + v * (facet.corners[3] - facet.corners[0]);
        ASSERT_TRUE(point.x > 0 && point.x < 12 && point.z > 0 && point.z < 12);
        EXPECT_FALSE(open[static_cast<std::size_t>(point.z) * 12 + static_cast<std::size_t>(point.x)]);
      }
    }
  }
  EXPECT_GE(found, 40);
}

TEST(Facets, TrianglesThatOnlyTouchAreNotJoined) {
  // Two squares side by side that share no vertices along their border by place, but overlap by a hair.
  LevelSurface surface = wall(1, [](auto, auto) { return false; });
  LevelSurface other = surface;
  for (glm::vec3& position : other.positions)
    position += glm::vec3(0.999F, 0.0F, 0.3F);
  append(surface, other);
  for (const Facet& facet : facetsOf(surface))
    EXPECT_LE(facet.area, 1.0);
}

TEST(Facets, CurvedSurfacesHaveNone) {
  EXPECT_TRUE(facetsOf(ball(48)).empty());
  EXPECT_EQ(facetsOf(surfaceOf(test::box({1, 1, 1}))).size(), 4U) << "of six faces";
}

/// A document of one mesh.
tinygltf::Model documentOf(const asset::Primitive& source, const std::string& alphaMode = "OPAQUE") {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.materials.resize(1);
  model.materials[0].alphaMode = alphaMode;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  primitive.attributes["POSITION"] = asset::appendVec3(model, source.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = asset::appendIndices(model, source.indices);
  tinygltf::Mesh mesh;
  mesh.name = "mesh";
  mesh.primitives = {primitive};
  test::showMesh(model, std::move(mesh));
  return model;
}

tinygltf::Model baked(tinygltf::Model model, bool quantize = false, std::uint32_t subdivide = 0) {
  BakeOptions options;
  options.chain.levels = 5;
  options.chain.samples = 500;
  options.occluders = true;
  options.subdivide = subdivide;
  bakeDocument(model, options, [](std::size_t, std::size_t, const std::string&) {});
  if (quantize) asset::quantizeModel(model);
  bakeOccluders(model, options);
  return model;
}

std::vector<asset::Occluder> occludersOf(const tinygltf::Model& model) {
  const asset::SceneFile file = asset::readScene(asset::parseGltf(asset::encodeGlb(model), "baked.glb"), "baked.glb");
  return file.chains.at(0).occluders;
}

asset::Primitive roundBall() {
  asset::Primitive primitive = test::sphere(32, 16);
  for (glm::vec3& position : primitive.positions)
    position = glm::round(position * 4096.0F) / 4096.0F;
  return primitive;
}

TEST(BakeOccluders, AClosedMeshGetsBoxesForAllLevels) {
  const tinygltf::Model model = baked(documentOf(roundBall()));
  const std::vector<InspectedChain> chains = inspectModel(model);
  ASSERT_EQ(chains.size(), 1U);
  ASSERT_GE(chains[0].levels.size(), 3U);
  const std::vector<asset::Occluder> occluders = occludersOf(model);
  ASSERT_GE(occluders.size(), 1U);
  EXPECT_EQ(occluders[0].levels, chains[0].levels.size());
  EXPECT_EQ(chains[0].occluders, occluders);
  EXPECT_NE(inspectText(chains).find("occluder: solid of 6 faces"), std::string::npos);
  EXPECT_NE(inspectJson(chains).find("\"occluders\""), std::string::npos);
  EXPECT_EQ(asset::encodeGlb(baked(documentOf(roundBall()))), asset::encodeGlb(model)) << "equal bytes";
}

TEST(BakeOccluders, AnOpenMeshGetsFacetsOfItsFinestLevel) {
  asset::Primitive house = test::box({2, 1, 2});
  house.indices.resize(house.indices.size() - 6);  // without one face
  const std::vector<asset::Occluder> occluders = occludersOf(baked(documentOf(house)));
  ASSERT_GE(occluders.size(), 2U);
  for (const asset::Occluder& occluder : occluders) {
    EXPECT_TRUE(occluder.solid.isPolygon());
    EXPECT_FALSE(occluder.solid.bothSides);
    EXPECT_EQ(occluder.levels, 1U);
  }
}

TEST(BakeOccluders, QuantizedMeshesGetThemInTheirOwnSpace) {
  const std::vector<asset::Occluder> plain = occludersOf(baked(documentOf(roundBall())));
  const tinygltf::Model model = baked(documentOf(roundBall()), /*quantize=*/true);
  const std::vector<asset::Occluder> occluders = occludersOf(model);
  ASSERT_EQ(occluders.size(), plain.size());
  const glm::vec3 extent = boundsOf(occluders[0].solid).extent();
  EXPECT_LT(extent.x, 1.0F) << "object space is the grid's";
  EXPECT_GT(extent.x, 0.2F);
}

TEST(BakeOccluders, OpenAndTransparentMeshesHaveNone) {
  asset::Primitive open = roundBall();
  open.indices.resize(open.indices.size() / 2);
  EXPECT_TRUE(occludersOf(baked(documentOf(open))).empty());
  EXPECT_TRUE(occludersOf(baked(documentOf(roundBall(), "BLEND"))).empty());
  EXPECT_TRUE(occludersOf(baked(documentOf(roundBall(), "MASK"))).empty());
}

TEST(BakeOccluders, AuthoredOnesAreKeptAndProvenWhereTheyCanBe) {
  const asset::Occluder inside{solidOf({glm::vec3(-0.3F), glm::vec3(0.3F)}), 1};
  const asset::Occluder doubtful{solidOf({glm::vec3(-0.68F), glm::vec3(0.68F)}), 9};  // its corners stand out
  tinygltf::Model model = documentOf(roundBall());
  asset::setOccluders(model.meshes[0], std::vector{inside, doubtful});
  const std::vector<asset::Occluder> occluders = occludersOf(baked(model));
  ASSERT_EQ(occluders.size(), 2U);
  EXPECT_EQ(occluders[0].solid, inside.solid);
  EXPECT_GT(occluders[0].levels, 2U);
  EXPECT_EQ(occluders[1].levels, 1U) << "for the level that it was made for";
}

TEST(BakeOccluders, SubdivisionMovesTheSurfaceAndNewOnesAreFound) {
  const asset::Occluder authored{solidOf({glm::vec3(-0.1F), glm::vec3(0.1F)}), 1};
  tinygltf::Model model = documentOf(roundBall());
  asset::setOccluders(model.meshes[0], std::vector{authored});
  const std::vector<asset::Occluder> occluders = occludersOf(baked(model, false, 1));
  ASSERT_GE(occluders.size(), 1U);
  EXPECT_FALSE(occluders[0].solid == authored.solid);
}

}  // namespace
}  // namespace jalousie::bake
