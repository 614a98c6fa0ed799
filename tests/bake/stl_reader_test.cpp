// The STL reader: both kinds, welding, malformed files.
#include "bake/io/stl_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "bake/bake_fixtures.h"
#include "bake/surface_fixtures.h"

namespace jalousie::bake {
namespace {

using test::bytesOf;
using test::codeOf;

PolygonMesh readFile(std::span<const std::byte> bytes, const std::filesystem::path& file) {
  Notes notes;
  return readStl(bytes, file, notes);
}

std::string binaryStl(const asset::Primitive& mesh) {
  std::string text(80, 's');
  const auto put = [&](const void* data, std::size_t size) { text.append(static_cast<const char*>(data), size); };
  const auto triangles = static_cast<std::uint32_t>(mesh.indices.size() / 3);
  put(&triangles, 4);
  for (std::size_t t = 0; t < triangles; ++t) {
    const float normal[3] = {0, 0, 0};
    put(normal, 12);
    for (std::size_t k = 0; k < 3; ++k)
      put(&mesh.positions[mesh.indices[3 * t + k]], 12);
    text.append(2, '\0');  // the attribute
  }
  return text;
}

std::string asciiStl(const asset::Primitive& mesh, const std::string& name) {
  std::string text = "solid " + name + "\n";
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3& p = mesh.positions[mesh.indices[t + k]];
      text += fmt::format("   vertex {} {} {}\n", p.x, p.y, p.z);
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

TEST(StlReader, BothKindsAreWeldedAndGetNormals) {
  const asset::Primitive ball = test::sphere(24, 12);
  for (const std::string& text : {binaryStl(ball), asciiStl(ball, "a ball")}) {
    const TriangleMesh mesh = test::onlyPart(readFile(bytesOf(text), "x.stl"), NormalRule::kCreases);
    EXPECT_EQ(mesh.indices.size(), ball.indices.size());
    EXPECT_LE(mesh.positions.size(), 24U * 11U + 2U);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      EXPECT_GT(glm::dot(mesh.normals[v], glm::normalize(mesh.positions[v])), 0.97F);
  }
}

TEST(StlReader, EdgesOfABoxStaySharp) {
  const TriangleMesh mesh =
      test::onlyPart(readFile(bytesOf(binaryStl(test::box(glm::vec3(1)))), "x.stl"), NormalRule::kCreases);
  EXPECT_EQ(mesh.positions.size(), 24U);
}

TEST(StlReader, SolidsAreObjects) {
  const std::string text = asciiStl(test::sphere(8, 4), "first") + asciiStl(test::box(glm::vec3(1)), "second");
  const std::vector<SurfaceObject> objects = buildObjects(readFile(bytesOf(text), "x.stl"), NormalRule::kNone);
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[1].name, "second");
  EXPECT_EQ(objects[1].parts[0].mesh.indices.size(), 36U);
}

TEST(StlReader, BinaryFilesMayBeginWithTheWordOfTextFiles) {
  std::string text = binaryStl(test::box(glm::vec3(1)));
  text.replace(0, 9, "solid box");
  text[84 + 48] = 7;  // the attribute of the first facet, which some programs use for its colour
  text += "8 bytes!";
  Notes notes;
  EXPECT_EQ(readStl(bytesOf(text), "x.stl", notes).faces.size(), 12U);
  EXPECT_EQ(notes.lines(), (std::vector<std::string>{"bytes after the last STL facet are left out: 8 bytes",
                                                     "colours of STL facets are left out: 1 facets"}));
}

TEST(StlReader, KeywordsMayBeInCapitals) {
  std::string text = asciiStl(test::box(glm::vec3(1)), "box");
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  const PolygonMesh mesh = readFile(bytesOf(text), "x.stl");
  EXPECT_EQ(mesh.faces.size(), 12U);
  EXPECT_EQ(mesh.objects.back(), "BOX");
}

TEST(StlReader, BrokenFilesAreErrors) {
  const std::string binary = binaryStl(test::box(glm::vec3(1)));
  const std::string ascii = asciiStl(test::box(glm::vec3(1)), "x");
  std::string nan = binary;
  const float value = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&nan[100], &value, 4);
  std::string word = ascii;
  word.replace(word.find("vertex") + 7, 1, "x");
  for (const std::string& text : {std::string(), binary.substr(0, binary.size() - 1), nan, word,
                                  ascii.substr(0, ascii.find("endloop")), std::string("solid x\nvertex 0 0\n")})
    EXPECT_EQ(codeOf([&] { readFile(bytesOf(text), "x.stl"); }), ErrorCode::kMalformed) << text.size();
  for (const std::string& text : {std::string(84, '\0'), std::string("solid x\nendsolid x\n")})
    EXPECT_EQ(codeOf([&] { readFile(bytesOf(text), "x.stl"); }), ErrorCode::kUnsupported) << text.size();
}

}  // namespace
}  // namespace jalousie::bake
