// Features that a collapse keeps: borders, seams, materials, mirrored texture, hard edges, the largest part.
#include "bake/simplify/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "bake/bake_fixtures.h"
#include "bake/mesh/hard_edges.h"
#include "bake/mesh/loose_parts.h"
#include "bake/simplify/chain.h"
#include "bake/simplify/collapse_checks.h"
#include "bake/simplify/collapse_error.h"
#include "bake/simplify/collapse_topology.h"
#include "bake/simplify/draft.h"
#include "bake/simplify/measure.h"
#include "bake/simplify/refit.h"
#include "core/random.h"

namespace jalousie::bake {
namespace {

WedgeMesh collapsed(const WedgeMesh& mesh, std::uint32_t target, const CollapseOptions& options = {}) {
  EdgeCollapser collapser(mesh, options);
  collapser.collapseTo(target);
  EXPECT_EQ(collapser.triangles(), collapser.mesh().triangles());
  return collapser.mesh();
}

glm::vec2 uvOf(const WedgeMesh& mesh, std::uint32_t wedge) {
  const float* values = &mesh.attributes[std::size_t{wedge} * mesh.stride + mesh.slot("TEXCOORD_0")->offset];
  return {values[0], values[1]};
}

double signedUvArea(const WedgeMesh& mesh, std::uint32_t t) {
  const glm::dvec2 a(uvOf(mesh, mesh.corners[3 * std::size_t{t}]));
  const glm::dvec2 b(uvOf(mesh, mesh.corners[3 * std::size_t{t} + 1]));
  const glm::dvec2 c(uvOf(mesh, mesh.corners[3 * std::size_t{t} + 2]));
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

std::set<std::array<float, 3>> borderPositions(const WedgeMesh& mesh) {
  std::set<std::array<float, 3>> result;
  for (const MeshEdge& edge : findEdges(mesh).edges)
    if (edge.kind == EdgeKind::kBorder)
      for (const std::uint32_t v : {edge.a, edge.b})
        result.insert({mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z});
  return result;
}

/// A wavy grid, so that collapses cost something.
asset::Primitive waves(std::uint32_t n) {
  asset::Primitive mesh = test::grid(n);
  for (glm::vec3& p : mesh.positions)
    p.z = 0.05F * std::sin(9.0F * p.x) * std::cos(7.0F * p.y);
  return mesh;
}

TEST(Collapse, FlatSquareBecomesTwoTrianglesPerAreaAndKeepsItsOutline) {
  const WedgeMesh level = collapsed(test::wedges(test::grid(16)), 8);
  double area = 0.0;
  for (std::uint32_t t = 0; t < level.triangles(); ++t) {
    const glm::vec3 a = level.positions[level.vertexAt(3 * std::size_t{t})];
    const glm::vec3 b = level.positions[level.vertexAt(3 * std::size_t{t} + 1)];
    const glm::vec3 c = level.positions[level.vertexAt(3 * std::size_t{t} + 2)];
    area += 0.5 * static_cast<double>(glm::cross(b - a, c - a).z);
  }
  EXPECT_LE(level.triangles(), 8U);
  EXPECT_NEAR(area, 1.0, 1e-4);  // the outline and no fold: signed area is the square's
}

TEST(Collapse, LockedBorderDoesNotMove) {
  const WedgeMesh mesh = makeWedges(test::combinedTextured(waves(12)));
  CollapseOptions options;
  options.lockBorder = true;
  EdgeCollapser collapser(mesh, options);
  collapser.collapseTo(100);
  WedgeMesh level = collapser.mesh();
  EXPECT_LT(level.triangles(), 150U);
  RefitOptions refit;
  refit.lockBorder = true;
  refitLevel(mesh, collapser.vertexMap(), refit, level);
  EXPECT_EQ(borderPositions(level), borderPositions(mesh));
}

TEST(Collapse, DraftLocksBordersToo) {
  const WedgeMesh mesh = makeWedges(test::combinedTextured(waves(12)));
  ChainOptions options;
  options.preset = Preset::kDraft;
  options.levels = 2;
  options.samples = 1000;
  options.collapse.lockBorder = true;
  const LevelChain chain = makeChain(mesh, options);
  ASSERT_EQ(chain.levels.size(), 2U);
  EXPECT_EQ(borderPositions(chain.levels[1].mesh), borderPositions(mesh));
}

TEST(Collapse, HugeTinyAndFarAwayMeshesAreMadeLikeAnyOther) {
  for (const float scale : {1e18F, 1e-18F}) {
    asset::Primitive ball = test::sphere(32, 16);
    for (glm::vec3& p : ball.positions)
      p *= scale;
    const WedgeMesh level = collapsed(test::wedges(ball), 100);
    EXPECT_LE(level.triangles(), 100U);
    EXPECT_TRUE(test::isClosed(level));
    for (const glm::vec3& p : level.positions)
      EXPECT_NEAR(glm::length(glm::dvec3(p) / double{scale}), 1.0, 0.15);
  }
}

TEST(Collapse, TextureFollowsThePositionAndStaysClosedAtSeams) {
  // Two halves of one sheet, each with its own chart: u is mirrored on the right one.
  asset::Primitive sheet = waves(24);
  CombinedMesh source = test::combinedTextured(sheet);
  Attribute& uvs = source.primitives[0].attributes[2];
  std::vector<std::uint32_t> twin(source.positions.size());
  const std::size_t vertices = source.positions.size();
  for (std::size_t v = 0; v < vertices; ++v) {
    twin[v] = static_cast<std::uint32_t>(source.positions.size());
    source.positions.push_back(source.positions[v]);
    source.primitiveOf.push_back(0);
    for (Attribute& attribute : source.primitives[0].attributes)
      for (std::uint32_t k = 0; k < attribute.components; ++k)
        attribute.values.push_back(attribute.values[v * attribute.components + k]);
    uvs.values[uvs.values.size() - 2] = 5.0F - uvs.values[2 * v];
  }
  source.primitives[0].vertexCount = static_cast<std::uint32_t>(source.positions.size());
  for (std::size_t t = 0; t < source.indices.size(); t += 3) {
    float x = 0.0F;
    for (std::size_t k = 0; k < 3; ++k)
      x += source.positions[source.indices[t + k]].x / 3.0F;
    if (x < 0.5F) continue;
    for (std::size_t k = 0; k < 3; ++k)
      source.indices[t + k] = twin[source.indices[t + k]];
  }
  const WedgeMesh mesh = makeWedges(source);
  const WedgeMesh level = collapsed(mesh, mesh.triangles() / 8);
  EXPECT_LE(level.triangles(), mesh.triangles() / 8);
  for (std::uint32_t t = 0; t < level.triangles(); ++t) {
    const bool mirrored = uvOf(level, level.corners[3 * std::size_t{t}]).x > 2.5F;
    EXPECT_TRUE(mirrored ? signedUvArea(level, t) < 1e-9 : signedUvArea(level, t) > -1e-9) << t;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t wedge = level.corners[3 * std::size_t{t} + k];
      const glm::vec2 uv = uvOf(level, wedge);
      EXPECT_EQ(uv.x > 2.5F, mirrored);  // no triangle spans both charts
      const glm::vec3 p = level.positions[level.vertexOf[wedge]];
      EXPECT_NEAR(mirrored ? 5.0F - uv.x : uv.x, p.x, 0.03F);
      EXPECT_NEAR(uv.y, p.y, 0.03F);
    }
  }
  for (const MeshEdge& edge : findEdges(level).edges) {
    EXPECT_NE(edge.kind, EdgeKind::kNonManifold);
    if (edge.kind != EdgeKind::kBorder) continue;  // borders only where the sheet ends
    const glm::vec3 m = 0.5F * (level.positions[edge.a] + level.positions[edge.b]);
    EXPECT_LT(std::min({m.x, m.y, 1.0F - m.x, 1.0F - m.y}), 0.02F);
  }
}

TEST(Collapse, TangentsFollowAndStayUsable) {
  const asset::Primitive sheet = waves(24);
  CombinedMesh source = test::combinedTextured(sheet);
  Attribute tangents{"TANGENT", 4, {}};
  for (std::size_t v = 0; v < source.positions.size(); ++v)
    tangents.values.insert(tangents.values.end(), {1.0F, 0.0F, 0.0F, -1.0F});
  source.primitives[0].attributes.push_back(tangents);
  const WedgeMesh mesh = makeWedges(source);
  EdgeCollapser collapser(mesh, {});
  collapser.collapseTo(mesh.triangles() / 10);
  WedgeMesh level = collapser.mesh();
  refitLevel(mesh, collapser.vertexMap(), {}, level);
  const CombinedMesh written = combineWedges(level, source);
  const std::vector<float>& n = written.primitives[0].attributes[1].values;
  const std::vector<float>& t = written.primitives[0].attributes[3].values;
  for (std::size_t v = 0; v < written.positions.size(); ++v) {
    EXPECT_NEAR(std::hypot(t[4 * v], t[4 * v + 1], t[4 * v + 2]), 1.0, 1e-5);
    EXPECT_NEAR(n[3 * v] * t[4 * v] + n[3 * v + 1] * t[4 * v + 1] + n[3 * v + 2] * t[4 * v + 2], 0.0, 2e-3);
    EXPECT_EQ(t[4 * v + 3], -1.0F);
    EXPECT_GT(t[4 * v], 0.7F);
  }
}

/// The triangles of a mesh in two primitives with the same vertices: those with y above 0 are in the second one.
CombinedMesh withTwoMaterials(const asset::Primitive& mesh) {
  CombinedMesh source = test::combined(mesh);
  const CombinedMesh copy = source;
  const auto vertices = static_cast<std::uint32_t>(copy.positions.size());
  PrimitiveData second = copy.primitives[0];
  second.firstVertex = vertices;
  source.positions.insert(source.positions.end(), copy.positions.begin(), copy.positions.end());
  source.primitiveOf.resize(source.positions.size(), 1);
  source.primitives.push_back(second);
  for (std::size_t t = 0; t < source.indices.size(); t += 3) {
    float y = 0.0F;
    for (std::size_t k = 0; k < 3; ++k)
      y += source.positions[source.indices[t + k]].y;
    if (y < 0.0F) continue;
    for (std::size_t k = 0; k < 3; ++k)
      source.indices[t + k] += vertices;
  }
  return source;
}

TEST(Collapse, BordersBetweenMaterialsStayWatertight) {
  const WedgeMesh level = collapsed(makeWedges(withTwoMaterials(test::sphere(48, 32))), 200);
  EXPECT_LE(level.triangles(), 200U);
  EXPECT_TRUE(test::isClosed(level));
  std::set<std::uint32_t> primitives;
  double straying = 0.0;
  for (std::size_t t = 0; t < level.corners.size(); t += 3) {
    primitives.insert(level.primitiveOf[level.corners[t]]);
    for (std::size_t k = 1; k < 3; ++k)
      EXPECT_EQ(level.primitiveOf[level.corners[t + k]], level.primitiveOf[level.corners[t]]);
  }
  EXPECT_EQ(primitives.size(), 2U);
  for (const MeshEdge& edge : findEdges(level).edges)
    if (edge.kind == EdgeKind::kMaterial)
      straying = std::max(
          {straying, std::abs(double{level.positions[edge.a].y}), std::abs(double{level.positions[edge.b].y})});
  EXPECT_LT(straying, 0.12);  // the equator stays near the equator
}

/// Flat shading makes the draft choose among all wedges of a vertex, of which some belong to the other material.
TEST(Collapse, DraftKeepsEveryTriangleInOneMaterial) {
  const WedgeMesh mesh = makeWedges(withTwoMaterials(test::flatShaded(test::sphere(48, 32))));
  const std::vector<std::uint32_t> corners = draftCorners(mesh, mesh.corners, 300, false);
  ASSERT_LE(corners.size(), 3U * 330U);
  std::set<std::uint32_t> primitives;
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    primitives.insert(mesh.primitiveOf[corners[t]]);
    for (std::size_t k = 1; k < 3; ++k)
      EXPECT_EQ(mesh.primitiveOf[corners[t + k]], mesh.primitiveOf[corners[t]]) << "triangle " << t / 3;
  }
  EXPECT_EQ(primitives.size(), 2U);
}

TEST(Collapse, SmallLoosePartsGoTheLargestStays) {
  asset::Primitive many = test::sphere(32, 16);
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const asset::Primitive crumb = test::sphere(6, 4);
    const auto first = static_cast<std::uint32_t>(many.positions.size());
    const glm::vec3 place(random.uniform(2, 4), random.uniform(-1, 1), random.uniform(-1, 1));
    for (const glm::vec3& p : crumb.positions)
      many.positions.push_back(place + 0.02F * p);
    many.normals.insert(many.normals.end(), crumb.normals.begin(), crumb.normals.end());
    for (const std::uint32_t index : crumb.indices)
      many.indices.push_back(first + index);
  }
  const WedgeMesh mesh = test::wedges(many);
  ASSERT_EQ(findLooseParts(mesh).parts.size(), 61U);
  const WedgeMesh level = collapsed(mesh, 60);
  EXPECT_LE(level.triangles(), 60U);
  const LooseParts parts = findLooseParts(level);
  EXPECT_LT(parts.parts.size(), 15U);
  EXPECT_GT(parts.parts[parts.largest].radius, 0.8);
}

TEST(Collapse, CubeKeepsItsHardEdges) {
  // A cube of 6 x 2 x 8^2 triangles with face normals: every level down to 12 triangles is the same cube.
  asset::Primitive cube;
  for (int face = 0; face < 6; ++face) {
    const asset::Primitive side = test::grid(8);
    const auto first = static_cast<std::uint32_t>(cube.positions.size());
    const int axis = face / 2;
    for (const glm::vec3& p : side.positions) {
      glm::vec3 q;
      q[axis] = face % 2 == 0 ? 0.0F : 1.0F;
      q[(axis + 1) % 3] = face % 2 == 0 ? p.y : p.x;
      q[(axis + 2) % 3] = face % 2 == 0 ? p.x : p.y;
      glm::vec3 normal(0.0F);
      normal[axis] = face % 2 == 0 ? -1.0F : 1.0F;
      cube.positions.push_back(q);
      cube.normals.push_back(normal);
    }
    for (const std::uint32_t index : side.indices)
      cube.indices.push_back(first + index);
  }
  const WedgeMesh mesh = test::wedges(cube);
  ASSERT_TRUE(test::isClosed(mesh));
  const WedgeMesh level = collapsed(mesh, 12);
  EXPECT_EQ(level.triangles(), 12U);
  const Deviation deviation = DeviationMeter(mesh, {2000, 2000}).measure(level);
  EXPECT_LT(deviation.twoSided.max, 1e-4);
  EXPECT_LT(deviation.normalDegrees.mean, 0.5);
}

/// A flat square without a quarter of its cells: its outlines turn inwards, where a collapse can fold triangles.
WedgeMesh flatWithHoles(std::uint32_t n, std::uint32_t seed) {
  Random random(seed);
  asset::Primitive sheet = test::grid(n);
  std::vector<std::uint32_t> kept;
  for (std::size_t cell = 0; cell < sheet.indices.size(); cell += 6) {
    if (random.below(4) == 0) continue;
    kept.insert(kept.end(), sheet.indices.begin() + static_cast<std::ptrdiff_t>(cell),
                sheet.indices.begin() + static_cast<std::ptrdiff_t>(cell + 6));
  }
  sheet.indices = kept;
  return test::wedges(sheet);
}

TEST(Collapse, NoTriangleOfAFlatSheetTurnsOver) {
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const WedgeMesh mesh = flatWithHoles(20, seed);
    const WedgeMesh level = collapsed(mesh, mesh.triangles() / 6);
    EXPECT_LT(level.triangles(), mesh.triangles() / 2);
    for (std::uint32_t t = 0; t < level.triangles(); ++t) {
      const glm::vec3 a = level.positions[level.vertexAt(3 * std::size_t{t})];
      const glm::vec3 b = level.positions[level.vertexAt(3 * std::size_t{t} + 1)];
      const glm::vec3 c = level.positions[level.vertexAt(3 * std::size_t{t} + 2)];
      EXPECT_GT(glm::cross(b - a, c - a).z, -1e-6F) << "seed " << seed << ", triangle " << t;
    }
  }
}

TEST(Collapse, TrianglesThatStayMayNeitherTurnOverNorTurnFarNorVanish) {
  const WedgeMesh mesh = test::wedges(test::grid(2));
  const std::vector<glm::dvec3> positions(mesh.positions.begin(), mesh.positions.end());
  const EdgeTable edges = findEdges(mesh);
  const CollapseError error(mesh, edges, {}, positions);
  CollapseTopology topology(vertexIndices(mesh), mesh.corners, mesh.positions.size());
  CollapseChecks checks(mesh, positions, error, topology);
  const auto at = [&](double x, double y) {
    const auto found = std::find(positions.begin(), positions.end(), glm::dvec3(x, y, 0.0));
    return static_cast<std::uint32_t>(found - positions.begin());
  };
  const std::uint32_t u = at(0.5, 0.5);
  const std::uint32_t v = at(1.0, 0.5);
  EXPECT_TRUE(checks.keepsFacing(u, v, {0.5, 0.5, 0.0}));
  EXPECT_TRUE(checks.keepsFacing(u, v, {0.7, 0.5, 0.05}));
  EXPECT_FALSE(checks.keepsFacing(u, v, {-0.3, 0.5, 0.0})) << "triangles left of u turn over";
  EXPECT_FALSE(checks.keepsFacing(u, v, {0.5, 1.4, 0.0})) << "triangles above turn over";
  EXPECT_FALSE(checks.keepsFacing(u, v, {0.5, 0.5, 9.0})) << "triangles turn by almost 90 degrees";
  EXPECT_FALSE(checks.keepsFacing(u, v, {0.0, 0.5, 0.0})) << "a triangle left of u loses its area";
}

TEST(Refit, BringsALevelNearerAndTurnsItsNormalsRight) {
  const WedgeMesh mesh = test::wedges(test::sphere(96, 64));
  EdgeCollapser collapser(mesh, {});
  collapser.collapseTo(300);
  const WedgeMesh before = collapser.mesh();
  WedgeMesh after = before;
  for (glm::vec3& p : after.positions)
    p *= 0.97F;  // a level that does not fit
  refitLevel(mesh, collapser.vertexMap(), {}, after);
  const DeviationMeter meter(mesh, {20000, 5000});
  EXPECT_LE(meter.measure(after).twoSided.mean, 1.02 * meter.measure(before).twoSided.mean);
  EXPECT_LE(meter.measure(after).normalDegrees.mean, 1.05 * meter.measure(before).normalDegrees.mean);
  EXPECT_TRUE(test::isClosed(after));
}

TEST(HardEdges, AngleDecidesWhichEdgesAreHard) {
  CombinedMesh box = test::combined(test::box(glm::vec3(1)));
  rebuildNormals(box, 30.0);
  EXPECT_EQ(makeWedges(box).vertexOf.size(), 24U);  // three normals at each corner
  rebuildNormals(box, 120.0);
  const WedgeMesh smooth = makeWedges(box);
  EXPECT_EQ(smooth.vertexOf.size(), 8U);
  for (std::uint32_t w = 0; w < 8; ++w) {
    const glm::vec3 expected = glm::normalize(smooth.positions[smooth.vertexOf[w]]);
    EXPECT_LT(glm::distance(smooth.vec3At(w, *smooth.slot("NORMAL")), expected), 1e-5F);
  }
}

/// A closed ring of square sections.
asset::Primitive ring(std::uint32_t segments) {
  asset::Primitive mesh;
  for (std::uint32_t s = 0; s < segments; ++s) {
    const double angle = 2.0 * std::numbers::pi * s / segments;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const double radius = k == 0 || k == 3 ? 1.0 : 1.3;
      mesh.positions.emplace_back(radius * std::cos(angle), k < 2 ? 0.0 : 0.3, radius * std::sin(angle));
      mesh.normals.emplace_back(0.0F, 1.0F, 0.0F);
      const std::uint32_t a = 4 * s + k;
      const std::uint32_t b = 4 * s + (k + 1) % 4;
      const std::uint32_t c = 4 * ((s + 1) % segments) + k;
      const std::uint32_t d = 4 * ((s + 1) % segments) + (k + 1) % 4;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  }
  return mesh;
}

TEST(Collapse, DoesNotStopWhereTheTopologyWouldChange) {
  // Nine vertices is the least for a closed ring without pinches, which has 14 triangles and more.
  const WedgeMesh mesh = test::wedges(ring(24));
  EXPECT_LE(collapsed(mesh, 8).triangles(), 8U);
  EXPECT_GE(collapsed(mesh, 4).triangles(), kMinLevelTriangles);
  EXPECT_TRUE(test::isClosed(collapsed(mesh, 40)));  // as long as there is a legal way, the ring stays whole
}

TEST(Collapse, DropsAPartWhereTheCountCannotBeMet) {
  // Tetrahedra cannot collapse: 5 triangles are out of reach, 4 are not.
  asset::Primitive mesh;
  for (std::uint32_t t = 0; t < 3; ++t) {
    const float x = 3.0F * static_cast<float>(t);
    mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}});
    mesh.normals.insert(mesh.normals.end(), 4, glm::vec3(0, 1, 0));
    const std::uint32_t a = 4 * t;
    mesh.indices.insert(mesh.indices.end(), {a, a + 2, a + 1, a, a + 1, a + 3, a, a + 3, a + 2, a + 1, a + 2, a + 3});
  }
  const WedgeMesh source = test::wedges(mesh);
  EdgeCollapser collapser(source, {});
  collapser.collapseTo(5);
  EXPECT_EQ(collapser.triangles(), 4U);
  EXPECT_GE(collapser.removedParts(), 1U);
}

}  // namespace
}  // namespace jalousie::bake
