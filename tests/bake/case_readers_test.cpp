// Files in OBJ, PLY and STL: what the baked file shows is what the text says.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bake/case_files.h"
#include "core/file.h"

namespace jalousie::test {
namespace {

/// The least cosine between a vertex normal and the normal of a triangle at that vertex.
double leastAgreement(const asset::Primitive& primitive) {
  const bake::LevelSurface surface = surfaceOf(primitive);
  double least = 1.0;
  for (std::size_t c = 0; c < primitive.indices.size(); ++c)
    least = std::min(least, glm::dot(glm::normalize(areaVector(surface, c / 3)),
                                     glm::dvec3(primitive.normals[primitive.indices[c]])));
  return least;
}

// A fan around the first corner covers 9 and folds over itself.
TEST_F(CaseFiles, ConcaveL) {
  const BakedCase baked = bake("concave_L.obj");
  const bake::LevelSurface surface = surfaceOf(*baked.chain()[0]);
  ASSERT_EQ(surface.indices.size(), 3U * 4U);
  EXPECT_NEAR(areaOf(surface), 5.0, 1e-6);
  for (std::size_t t = 0; t < 4; ++t) {
    EXPECT_GT(areaVector(surface, t).z, 0.0);
    glm::vec3 middle(0.0F);
    for (std::size_t c = 3 * t; c < 3 * t + 3; ++c)
      middle += surface.positions[surface.indices[c]] / 3.0F;
    EXPECT_FALSE(middle.x > 1.0F && middle.y > 1.0F) << "in the notch";
  }
}

// Without normals in the file, a smooth cube is not what anybody drew.
TEST_F(CaseFiles, CubeNoNormals) {
  const BakedCase baked = bake("cube_no_normals.obj", [](bake::JobSettings& s) { s.bake.chain.levels = 1; });
  const asset::Primitive& cube = baked.chain()[0]->primitives.at(0);
  EXPECT_EQ(cube.indices.size(), 36U);
  EXPECT_TRUE(isClosed(surfaceOf(cube)));
  EXPECT_NEAR(volumeOf(surfaceOf(cube)), 1.0, 1e-6);
  EXPECT_GT(leastAgreement(cube), 0.9999);
}

// A tube with walls of a twentieth of its radius: smooth walls, rims of 90 degrees.
TEST_F(CaseFiles, HollowCylinder) {
  const BakedCase baked = bake("hollow_cylinder.obj", [](bake::JobSettings& s) { s.bake.chain.ratios = {0.5, 0.25}; });
  // The area of a ring of two polygons of 64 sides, times the height.
  const double expected = 32.0 * std::sin(2.0 * M_PI / 64.0) * (1.0 - 0.95 * 0.95) * 20.0;
  EXPECT_NEAR(volumeOf(surfaceOf(*baked.chain()[0])), expected, 1e-4);
  EXPECT_GT(leastAgreement(baked.chain()[0]->primitives.at(0)), std::cos(M_PI / 64.0) - 1e-4);
  ASSERT_EQ(baked.chain().size(), 3U);
  for (const asset::Mesh* mesh : baked.chain()) {
    const bake::LevelSurface surface = surfaceOf(*mesh);
    EXPECT_TRUE(isClosed(surface));
    EXPECT_EQ(eulerNumber(surface), 0) << "a tube has one hole";
    EXPECT_NEAR(volumeOf(surface), expected, 0.05 * expected) << surface.indices.size() / 3;
  }
  // Walls of 32 sides and of 16 that keep the radius: 1 - cos(pi / sides) of the radius, of a diagonal of 20.2.
  EXPECT_LT(baked.errorPercent(1), 0.03);
  EXPECT_LT(baked.errorPercent(2), 0.1);
}

/// The places that "v" lines name.
std::vector<glm::dvec3> vertexLines(const std::vector<std::vector<std::string>>& lines, const std::string& word) {
  std::vector<glm::dvec3> places;
  for (const std::vector<std::string>& line : lines)
    if (line.size() >= 4 && line[0] == word)
      places.emplace_back(std::stod(line[1]), std::stod(line[2]), std::stod(line[3]));
  return places;
}

// A sphere of radius 10 at 4.6 million metres, where a float has steps of half a metre.
TEST_F(CaseFiles, UtmSphere) {
  const std::vector<glm::dvec3> places = vertexLines(readLines("utm_sphere.obj"), "v");
  const BakedCase baked = bake("utm_sphere.obj");
  const std::vector<double>& offset = baked.model.nodes.at(0).translation;
  ASSERT_EQ(offset.size(), 3U);
  ASSERT_EQ(baked.chain().size(), 5U);
  const tinygltf::Primitive& finest = baked.model.meshes.at(0).primitives.at(0);
  const std::vector<glm::vec3> positions = asset::readVec3(baked.model, finest.attributes.at("POSITION"), 10'000);
  EXPECT_GE(positions.size(), 1986U);
  for (const glm::vec3& p : positions) {
    const glm::dvec3 written = glm::dvec3(p) + glm::dvec3(offset[0], offset[1], offset[2]);
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& place : places)
      nearest = std::min(nearest, glm::distance(place, written));
    ASSERT_LT(nearest, 2e-6);
  }
  for (const tinygltf::Node& node : baked.model.nodes)
    EXPECT_EQ(node.translation, offset);
  // Coordinates rounded to floats gave 1.6 %.
  const bake::LevelSurface original = surfaceOf(*baked.chain()[0]);
  EXPECT_LT(baked.errorPercent(1), 0.25);
  EXPECT_LT(largestDistanceBothWays(surfaceOf(*baked.chain()[1]), original, 4), 0.0025 * diagonalOf(original));
}

// Coordinates of 1e7: the stored maximum holds and is no more than a tenth too large, whatever made the levels.
TEST_F(CaseFiles, Scale1e06) {
  for (const bake::Preset preset : {bake::Preset::kBest, bake::Preset::kFast, bake::Preset::kDraft}) {
    const BakedCase baked = bake("scale_1e+06.ply", [&](bake::JobSettings& s) { s.bake.chain.preset = preset; });
    ASSERT_EQ(baked.chain().size(), 5U);
    const bake::LevelSurface original = surfaceOf(*baked.chain()[0]);
    EXPECT_GT(diagonalOf(original), 1e7);
    for (std::size_t k = 1; k < 5; ++k) {
      const double found = largestDistanceBothWays(surfaceOf(*baked.chain()[k]), original, 6);
      const double stored = baked.scene.chains[0].levels[k].errorObject;
      EXPECT_GE(stored, found) << k;
      EXPECT_LE(stored, 1.1 * found) << k;
    }
  }
}

/// The triangles of strips that end at -1, without those that have no area.
bake::LevelSurface strips(const std::vector<std::vector<std::string>>& lines) {
  bake::LevelSurface surface;
  std::vector<std::int64_t> strip;
  const auto close = [&] {
    for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
      const std::size_t odd = i % 2;
      const std::array<std::int64_t, 3> t = {strip[i + odd], strip[i + 1 - odd], strip[i + 2]};
      const auto at = [&](std::size_t c) { return surface.positions[static_cast<std::size_t>(t[c])]; };
      if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0)) continue;
      for (const std::int64_t v : t)
        surface.indices.push_back(static_cast<std::uint32_t>(v));
    }
    strip.clear();
  };
  const auto body = std::find(lines.begin(), lines.end(), std::vector<std::string>{"end_header"});
  for (auto line = body + 1; line != lines.end(); ++line) {
    if (line->size() == 3)
      surface.positions.emplace_back(std::stof(line->at(0)), std::stof(line->at(1)), std::stof(line->at(2)));
    for (std::size_t i = 1; line->size() > 3 && i < line->size(); ++i) {
      if (line->at(i) == "-1") {
        close();
      } else {
        strip.push_back(std::stoll(line->at(i)));
      }
    }
  }
  close();
  return surface;
}

// "tristrips" instead of "face", as scans of the nineties have it.
TEST_F(CaseFiles, PlyTristrips) {
  const bake::LevelSurface expected = strips(readLines("ply_tristrips.ply"));
  ASSERT_TRUE(isClosed(expected));
  const BakedCase baked = bake("ply_tristrips.ply");
  const bake::LevelSurface surface = surfaceOf(*baked.chain()[0]);
  EXPECT_EQ(surface.indices.size(), expected.indices.size());
  EXPECT_EQ(edgesOf(surface).size(), edgesOf(expected).size());
  EXPECT_TRUE(isClosed(surface));
  EXPECT_NEAR(volumeOf(surface), volumeOf(expected), 1e-5);
  EXPECT_GT(volumeOf(surface), 0.0) << "every other triangle of a strip is turned round";
  EXPECT_NEAR(areaOf(surface), areaOf(expected), 1e-5);
}

/// Texture coordinates of the three corners of a triangle, by their places from the least on.
using TexturedTriangles = std::map<std::array<Place, 3>, std::array<glm::vec2, 3>>;

void addTriangle(TexturedTriangles& triangles, std::array<Place, 3> places, std::array<glm::vec2, 3> uvs) {
  const auto least = std::min_element(places.begin(), places.end()) - places.begin();
  std::rotate(places.begin(), places.begin() + least, places.end());
  std::rotate(uvs.begin(), uvs.begin() + least, uvs.end());
  EXPECT_TRUE(triangles.emplace(places, uvs).second);
}

/// Vertices and faces as "3 a b c 6 u v u v u v number".
TexturedTriangles facesOf(const std::vector<std::vector<std::string>>& lines) {
  std::vector<Place> places;
  TexturedTriangles triangles;
  const auto body = std::find(lines.begin(), lines.end(), std::vector<std::string>{"end_header"});
  for (auto line = body + 1; line != lines.end(); ++line) {
    if (line->size() == 3) places.push_back({std::stof(line->at(0)), std::stof(line->at(1)), std::stof(line->at(2))});
    if (line->size() != 12) continue;
    std::array<Place, 3> corners;
    std::array<glm::vec2, 3> uvs;
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = places.at(std::stoul(line->at(1 + c)));
      uvs[c] = {std::stof(line->at(5 + 2 * c)), 1.0F - std::stof(line->at(6 + 2 * c))};  // v of PLY rises
    }
    addTriangle(triangles, corners, uvs);
  }
  return triangles;
}

/// Whether the only picture of the file has the bytes of another file.
void expectPicture(const BakedCase& baked, const std::filesystem::path& picture) {
  ASSERT_EQ(baked.glb.json["images"].size(), 1U);
  EXPECT_EQ(baked.glb.view(baked.glb.json["images"][0]["bufferView"].get<std::size_t>()), readFile(picture, 1U << 20U));
  ASSERT_FALSE(baked.scene.materials.empty());
  EXPECT_TRUE(baked.scene.materials[0].baseTexture.has_value());
}

// MeshLab keeps texture coordinates with faces, and the picture's name in a comment.
TEST_F(CaseFiles, MeshlabWedgeUv) {
  const BakedCase baked = bake("meshlab_wedge_uv.ply");
  expectPicture(baked, file("photo.png"));
  const TexturedTriangles expected = facesOf(readLines("meshlab_wedge_uv.ply"));
  ASSERT_EQ(expected.size(), 2208U);
  const asset::Primitive& finest = baked.chain()[0]->primitives.at(0);
  TexturedTriangles written;
  for (std::size_t t = 0; t < finest.indices.size(); t += 3) {
    const auto at = [&](std::size_t c) { return finest.indices[t + c]; };
    addTriangle(written,
                {placeOf(finest.positions[at(0)]), placeOf(finest.positions[at(1)]), placeOf(finest.positions[at(2)])},
                {finest.uvs[at(0)], finest.uvs[at(1)], finest.uvs[at(2)]});
  }
  ASSERT_EQ(written.size(), expected.size());
  for (const auto& [places, uvs] : expected) {
    const auto found = written.find(places);
    ASSERT_NE(found, written.end());
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_LT(glm::distance(found->second[c], uvs[c]), 1e-6F);
  }
  for (const asset::Mesh* mesh : baked.chain())
    EXPECT_TRUE(isClosed(surfaceOf(*mesh))) << "the seam of the texture is no gap";
}

// Every triangle of an STL file has three vertices of its own.
TEST_F(CaseFiles, Ball) {
  const std::vector<glm::dvec3> corners = vertexLines(readLines("ball.stl"), "vertex");
  ASSERT_EQ(corners.size(), 3U * 2208U);
  std::set<Place> places;
  for (const glm::dvec3& p : corners)
    places.insert(placeOf(glm::vec3(p)));
  const BakedCase baked = bake("ball.stl");
  EXPECT_EQ(baked.chain()[0]->primitives.at(0).positions.size(), places.size()) << "smooth, so nothing stays apart";
  ASSERT_EQ(baked.chain().size(), 5U);
  for (const asset::Mesh* mesh : baked.chain()) {
    EXPECT_TRUE(isClosed(surfaceOf(*mesh)));
    EXPECT_EQ(eulerNumber(surfaceOf(*mesh)), 2);
    EXPECT_NEAR(volumeOf(surfaceOf(*mesh)), 4.0 / 3.0 * M_PI, 0.1 * 4.0) << mesh->primitives[0].indices.size() / 3;
  }
}

/// Two balls of orange. With the picture, every level has texture coordinates; without, LOD 0 keeps them.
void expectScan(const BakedCase& baked, bool hasPicture) {
  ASSERT_EQ(baked.scene.chains.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(baked.scene.chains[i].name, "part" + std::to_string(i));
    EXPECT_GE(baked.chain(i).size(), 4U);
    for (const asset::Mesh* mesh : baked.chain(i)) {
      const asset::Primitive& primitive = mesh->primitives.at(0);
      EXPECT_TRUE(isClosed(surfaceOf(*mesh)));
      const auto reaches = [](const glm::vec2& uv) { return uv.x > 0.4F && uv.y > 0.4F; };
      const bool isFinest = mesh == baked.chain(i)[0];
      EXPECT_EQ(std::any_of(primitive.uvs.begin(), primitive.uvs.end(), reaches), hasPicture || isFinest);
      for (const glm::vec4& c : primitive.colors)  // 0.5 of a display is 0.2140 of light
        ASSERT_LT(glm::distance(c, glm::vec4(1.0F, 0.2140F, 0.0F, 1.0F)), 1e-3F);
    }
  }
  EXPECT_EQ(baked.chain(0)[0]->primitives[0].indices.size(), 3U * 2208U);
  EXPECT_GT(leastAgreement(baked.chain(0)[0]->primitives[0]), 0.99) << "smooth";
}

// Objects, vertex colours and the picture of its materials; what is missing is told and does not stop the bake.
TEST_F(CaseFiles, TexturedScan) {
  const BakedCase baked = bake("textured_scan.obj");
  expectScan(baked, true);
  expectPicture(baked, file("photo.png"));
  EXPECT_FALSE(baked.warns("a picture is missing"));

  const std::filesystem::path copy = temporary("textured_scan.obj");
  std::filesystem::copy_file(file("textured_scan.obj"), copy);
  const auto nothing = [](bake::JobSettings&) {};
  const BakedCase alone = bakeFile(copy, nothing);
  expectScan(alone, false);
  EXPECT_TRUE(alone.warns("textured_scan.mtl"));

  std::filesystem::copy_file(file("textured_scan.mtl"), temporary("textured_scan.mtl"));
  const BakedCase unpictured = bakeFile(copy, nothing);
  expectScan(unpictured, false);
  EXPECT_FALSE(unpictured.warns("textured_scan.mtl"));
  EXPECT_TRUE(unpictured.warns("a picture is missing or cannot be read: photo.png"));
  EXPECT_FALSE(unpictured.scene.materials.at(0).baseTexture.has_value());
  EXPECT_EQ(unpictured.scene.materials.at(0).name, "skin");
}

}  // namespace
}  // namespace jalousie::test
