// Meshes whose shape a simplification breaks: borders, bridges, loose parts, foliage, flat shading, scenes of parts.
#include <algorithm>
#include <cmath>

#include "bake/case_files.h"

namespace jalousie::test {
namespace {

std::vector<bake::LevelSurface> surfacesOf(const BakedCase& baked, std::size_t chain = 0) {
  std::vector<bake::LevelSurface> surfaces;
  for (const asset::Mesh* mesh : baked.chain(chain))
    surfaces.push_back(surfaceOf(*mesh));
  return surfaces;
}

std::size_t trianglesOf(const bake::LevelSurface& surface) {
  return surface.indices.size() / 3;
}

// Copies of a vertex that differ in the last digits: the mesh falls into triangles.
TEST_F(CaseFiles, AlmostWelded) {
  const BakedCase loose = bake("almost_welded.glb");
  EXPECT_EQ(openEdges(surfacesOf(loose)[0]).size(), 11904U);
  const auto isHint = [](const std::string& line) { return line.find("--weld") != std::string::npos; };
  const auto hint = std::find_if(loose.result.warnings.begin(), loose.result.warnings.end(), isHint);
  ASSERT_NE(hint, loose.result.warnings.end());
  const double distance = std::stod(hint->substr(hint->find("--weld") + 6));  // what a user would type
  EXPECT_GT(distance, 0.0);
  EXPECT_LT(distance, 0.001);
  const BakedCase welded = bake("almost_welded.glb", [&](bake::JobSettings& s) { s.bake.weld = distance; });
  const std::vector<bake::LevelSurface> levels = surfacesOf(welded);
  ASSERT_EQ(levels.size(), 5U);
  EXPECT_EQ(trianglesOf(levels[0]), 3968U);
  for (const bake::LevelSurface& level : levels) {
    EXPECT_TRUE(isClosed(level)) << trianglesOf(level);
    EXPECT_EQ(eulerNumber(level), 2);
  }
}

// A square sheet with a second one on its back: the outline is an edge of both.
TEST_F(CaseFiles, BackToBack) {
  const BakedCase baked =
      bake("back_to_back.glb", [](bake::JobSettings& s) { s.bake.chain.preset = bake::Preset::kFast; });
  const std::vector<bake::LevelSurface> levels = surfacesOf(baked);
  ASSERT_EQ(levels.size(), 5U);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    double up = 0.0;
    double down = 0.0;
    for (std::size_t t = 0; t < trianglesOf(levels[k]); ++t) {
      const double y = areaVector(levels[k], t).y;
      (y > 0.0 ? up : down) += y;
    }
    EXPECT_NEAR(up, 1.0, 0.005) << "the sheet covers the unit square at level " << k;
    EXPECT_NEAR(down, -1.0, 0.005) << k;
  }
  EXPECT_LT(baked.errorPercent(1), 0.1) << "2.2 % where the border gave way";
  EXPECT_LT(baked.errorPercent(4), 0.5);
}

// 600 boxes of 48 triangles, all in one list of vertices. A box needs 12.
TEST_F(CaseFiles, BimSharedVertices) {
  const BakedCase baked = bake("bim_shared_vertices.glb", [](bake::JobSettings& s) { s.bake.chain.ratios = {0.25}; });
  ASSERT_EQ(baked.scene.chains.size(), 600U);
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < 600; ++i) {
    const std::vector<const asset::Mesh*> chain = baked.chain(i);
    ASSERT_EQ(chain.size(), 2U) << i;
    vertices += chain[0]->primitives.at(0).positions.size();
    for (const asset::Mesh* mesh : chain) {
      const bake::LevelSurface surface = surfaceOf(*mesh);
      EXPECT_TRUE(isClosed(surface)) << i;
      EXPECT_NEAR(areaOf(surface), areaOf(surfaceOf(*chain[0])), 1e-4) << i;
    }
    triangles += trianglesOf(surfaceOf(*chain[1]));
    EXPECT_LT(baked.errorPercent(1, i), 0.0005) << i;
  }
  EXPECT_LE(vertices, 32400U) << "each part has only the vertices that it uses";
  EXPECT_LE(triangles, 600U * 12U);
}

// No vertex is shared, and each normal is that of its triangle.
TEST_F(CaseFiles, FlatSphere) {
  const BakedCase baked = bake("flat_sphere.glb");
  ASSERT_EQ(baked.chain().size(), 5U);
  for (const asset::Mesh* mesh : baked.chain()) {
    const asset::Primitive& primitive = mesh->primitives.at(0);
    const bake::LevelSurface surface = surfaceOf(primitive);
    EXPECT_TRUE(isClosed(surface));
    for (std::size_t c = 0; c < primitive.indices.size(); ++c)
      ASSERT_GT(
          glm::dot(glm::normalize(areaVector(surface, c / 3)), glm::dvec3(primitive.normals[primitive.indices[c]])),
          0.9998)
          << trianglesOf(surface);
  }
}

// A hall with 200 bars, which cannot have fewer than 4 triangles each: below 804 triangles, bars must go.
TEST_F(CaseFiles, Gallery) {
  const BakedCase baked = bake("gallery.glb", [](bake::JobSettings& s) { s.bake.chain.ratios = {0.5, 0.1, 0.01}; });
  const std::vector<bake::LevelSurface> levels = surfacesOf(baked);
  ASSERT_EQ(levels.size(), 4U);
  EXPECT_LE(trianglesOf(levels[3]), 204U);
  EXPECT_GT(baked.levels()[3]["removed_parts"].get<std::uint32_t>(), 0U);
  EXPECT_EQ(baked.levels()[1]["removed_parts"].get<std::uint32_t>(), 0U);
  for (const bake::LevelSurface& level : levels) {
    EXPECT_TRUE(isClosed(level)) << trianglesOf(level);
    EXPECT_NEAR(diagonalOf(level), diagonalOf(levels[0]), 0.01 * diagonalOf(levels[0]));
  }
  for (std::size_t k = 1; k < 3; ++k)
    EXPECT_NEAR(areaOf(levels[k]), areaOf(levels[0]), 0.05 * areaOf(levels[0])) << k;
  EXPECT_LT(baked.errorPercent(1), 0.05);
}

/// Area of each material, and so the mean colour, within 10 % down to 5 % of the triangles.
void expectFoliage(const BakedCase& baked, const asset::Mesh& input) {
  ASSERT_EQ(baked.chain().size(), 5U);
  for (const asset::Mesh* mesh : baked.chain()) {
    ASSERT_EQ(mesh->primitives.size(), input.primitives.size());
    for (std::size_t p = 0; p < input.primitives.size(); ++p) {
      const double expected = areaOf(surfaceOf(input.primitives[p]));
      EXPECT_EQ(mesh->primitives[p].material, input.primitives[p].material);
      EXPECT_NEAR(areaOf(surfaceOf(mesh->primitives[p])), expected, 0.1 * expected)
          << "material " << p << ", " << trianglesOf(surfaceOf(*mesh)) << " triangles";
    }
  }
  const std::size_t finest = trianglesOf(surfaceOf(*baked.chain()[0]));
  EXPECT_LE(trianglesOf(surfaceOf(*baked.chain().back())), finest / 20);
}

TEST_F(CaseFiles, LeafBall) {
  expectFoliage(bake("leaf_ball.glb"), readInput("leaf_ball.glb").meshes.at(0));
}

// Leaves swelled into planes where they were fitted to samples of twigs that had vanished.
TEST_F(CaseFiles, TwigsAndLeaflets) {
  expectFoliage(bake("twigs_and_leaflets.glb"), readInput("twigs_and_leaflets.glb").meshes.at(0));
}

/// Share of the area that faces away from the origin.
double outwardShare(const bake::LevelSurface& surface) {
  double outward = 0.0;
  for (std::size_t t = 0; t < trianglesOf(surface); ++t) {
    const glm::dvec3 area = areaVector(surface, t);
    if (glm::dot(area, glm::dvec3(surface.positions[surface.indices[3 * t]])) > 0.0) outward += glm::length(area);
  }
  return outward / areaOf(surface);
}

// Half of a ball faces inwards, in strips: both halves stay, and where they meet, nothing opens.
TEST_F(CaseFiles, MixedWinding) {
  const BakedCase baked = bake("mixed_winding.glb");
  const std::vector<bake::LevelSurface> levels = surfacesOf(baked);
  ASSERT_EQ(levels.size(), 5U);
  const double expected = outwardShare(surfaceOf(readInput("mixed_winding.glb").meshes.at(0)));
  EXPECT_TRUE(expected > 0.2 && expected < 0.8) << expected;
  EXPECT_EQ(baked.report["meshes"][0]["non_manifold_edges"], 1152);
  for (const bake::LevelSurface& level : levels) {
    for (const auto& [edge, uses] : edgesOf(level))
      ASSERT_EQ((uses.there + uses.back) % 2, 0) << trianglesOf(level);
    EXPECT_NEAR(outwardShare(level), expected, 0.25) << trianglesOf(level);
  }
  EXPECT_LT(baked.errorPercent(1), 1.0);
  EXPECT_LT(baked.errorPercent(2), 2.0);
}

/// Normal and texture coordinates of a vertex.
using Attributes = std::array<float, 5>;

/// The attributes of the vertices at some places, one at each.
std::map<Place, Attributes> attributesAt(const asset::Primitive& primitive, const std::set<Place>& places) {
  std::map<Place, Attributes> found;
  for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
    const glm::vec3 n = primitive.normals[v];
    const Place place = placeOf(primitive.positions[v]);
    if (!places.contains(place)) continue;
    const Attributes attributes = {n.x, n.y, n.z, primitive.uvs[v].x, primitive.uvs[v].y};
    EXPECT_TRUE(found.emplace(place, attributes).second) << "a seam that was not there";
  }
  return found;
}

/// The largest difference of two sets of attributes at the same places; normals are normalised again when read.
double largestDifference(const std::map<Place, Attributes>& a, const std::map<Place, Attributes>& b) {
  double largest = a.size() == b.size() ? 0.0 : 1.0;
  for (const auto& [place, attributes] : a)
    for (std::size_t k = 0; k < attributes.size(); ++k)
      largest = std::max(largest, std::abs(double{attributes[k]} - (b.contains(place) ? b.at(place)[k] : 9.0F)));
  return largest;
}

std::set<Place> endsOf(const std::set<PlacePair>& edges) {
  std::set<Place> ends;
  for (const auto& [a, b] : edges)
    ends.insert({a, b});
  return ends;
}

void lockBorder(bake::JobSettings& settings) {
  settings.bake.chain.collapse.lockBorder = true;
  settings.bake.chain.ratios = {0.5, 0.12};
}

/// The border of every level is that of the input, with all attributes.
void expectLockedBorder(const BakedCase& baked, const asset::SceneFile& input) {
  const asset::Primitive& source = input.meshes.at(0).primitives.at(0);
  const std::set<PlacePair> border = openEdges(surfaceOf(source));
  EXPECT_EQ(border.size(), 256U);
  ASSERT_EQ(baked.chain().size(), 3U);
  for (const asset::Mesh* mesh : baked.chain()) {
    const asset::Primitive& level = mesh->primitives.at(0);
    EXPECT_TRUE(openEdges(surfaceOf(level)) == border) << level.indices.size() / 3;
    EXPECT_LT(largestDifference(attributesAt(level, endsOf(border)), attributesAt(source, endsOf(border))), 1e-6);
  }
}

TEST_F(CaseFiles, Tile00) {
  expectLockedBorder(bake("tile_00.glb", lockBorder), readInput("tile_00.glb"));
}

/// Normals of the border at x = 1, which two tiles share, with 0 for the texture coordinates, which differ.
std::map<Place, Attributes> sharedNormals(const asset::Mesh& mesh) {
  std::map<Place, Attributes> normals;
  for (auto [place, attributes] : attributesAt(mesh.primitives.at(0), endsOf(openEdges(surfaceOf(mesh))))) {
    if (place[0] != 1.0F) continue;
    attributes[3] = attributes[4] = 0.0F;
    normals.emplace(place, attributes);
  }
  return normals;
}

// Neighbours that are baked one by one meet without a step and without a line in the shading, whatever levels meet.
TEST_F(CaseFiles, Tile10) {
  const BakedCase right = bake("tile_10.glb", lockBorder);
  expectLockedBorder(right, readInput("tile_10.glb"));
  const BakedCase left = bake("tile_00.glb", lockBorder);
  const std::map<Place, Attributes> expected = sharedNormals(readInput("tile_00.glb").meshes.at(0));
  EXPECT_EQ(expected.size(), 65U);
  for (const BakedCase* tile : {&left, &right})
    for (const asset::Mesh* mesh : tile->chain())
      EXPECT_LT(largestDifference(sharedNormals(*mesh), expected), 1e-6);
}

// A strip is triangles; those that only lead it round a corner have no area.
TEST_F(CaseFiles, TriangleStrip) {
  const BakedCase baked = bake("triangle_strip.glb");
  const std::vector<bake::LevelSurface> levels = surfacesOf(baked);
  ASSERT_EQ(levels.size(), 5U);
  EXPECT_EQ(trianglesOf(levels[0]), 2208U);
  EXPECT_NEAR(areaOf(levels[0]), 12.52156, 1e-4) << "as the same ball in a list";
  for (const bake::LevelSurface& level : levels) {
    EXPECT_TRUE(isClosed(level));
    EXPECT_EQ(eulerNumber(level), 2);
    EXPECT_GT(std::abs(volumeOf(level)), 3.5);
    EXPECT_EQ(volumeOf(level) > 0.0, volumeOf(levels[0]) > 0.0);
  }
  for (const tinygltf::Mesh& mesh : baked.model.meshes)
    EXPECT_EQ(mesh.primitives.at(0).mode, TINYGLTF_MODE_TRIANGLES);
}

// Two halves of a ball, each a mesh of its own. Their levels are chosen apart, so any two of them must fit.
TEST_F(CaseFiles, TwoMeshesTouching) {
  const std::set<PlacePair> seam = openEdges(surfaceOf(readInput("two_meshes_touching.glb").meshes.at(0)));
  EXPECT_EQ(seam.size(), 62U);
  const BakedCase baked = bake("two_meshes_touching.glb");
  ASSERT_EQ(baked.scene.chains.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<bake::LevelSurface> levels = surfacesOf(baked, i);
    ASSERT_GE(levels.size(), 4U);
    for (const bake::LevelSurface& level : levels)
      EXPECT_EQ(openEdges(level), seam) << "half " << i << ", " << trianglesOf(level) << " triangles";
  }
}

// Texture coordinates that no picture reads hold the flat faces of a panel together.
TEST_F(CaseFiles, UnusedUvPanel) {
  const auto half = [](bake::JobSettings& s) { s.bake.chain.ratios = {0.49}; };
  const BakedCase baked = bake("unused_uv_panel.glb", half);
  const std::vector<bake::LevelSurface> levels = surfacesOf(baked);
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_LE(trianglesOf(levels[1]), 95U);
  EXPECT_LT(baked.errorPercent(1), 0.0005);
  EXPECT_LT(largestDistanceBothWays(levels[0], levels[1], 8), 5e-6 * diagonalOf(levels[0]));
  const BakedCase kept = bake("unused_uv_panel.glb", [&](bake::JobSettings& s) {
    half(s);
    s.bake.keepUnused = true;
  });
  EXPECT_GT(kept.errorPercent(1), 0.1) << "the coordinates count here, so the levels above are good without them only";
}

/// Edges as triangles without area.
bake::LevelSurface linesOf(const std::set<PlacePair>& edges) {
  bake::LevelSurface lines;
  for (const auto& [a, b] : edges) {
    const auto first = static_cast<std::uint32_t>(lines.positions.size());
    lines.positions.emplace_back(a[0], a[1], a[2]);
    lines.positions.emplace_back(b[0], b[1], b[2]);
    lines.indices.insert(lines.indices.end(), {first, first + 1, first + 1});
  }
  return lines;
}

// A fine sheet and a coarse one, whose common line is closed by triangles without area.
TEST_F(CaseFiles, ZeroAreaBridges) {
  const BakedCase baked = bake("zero_area_bridges.glb");
  const std::vector<bake::LevelSurface> levels = surfacesOf(baked);
  ASSERT_EQ(levels.size(), 5U);
  const bake::LevelSurface border = linesOf(openEdges(surfaceOf(readInput("zero_area_bridges.glb").meshes.at(0))));
  EXPECT_EQ(trianglesOf(border), 84U);
  EXPECT_EQ(openEdges(levels[0]).size(), 84U);
  for (const bake::LevelSurface& level : levels)  // a slit is half a unit from the border
    EXPECT_LT(largestDistance(linesOf(openEdges(level)), border, 4), 0.1) << trianglesOf(level) << " triangles";
}

}  // namespace
}  // namespace jalousie::test
