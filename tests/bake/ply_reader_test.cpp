// The PLY reader on every encoding and on malformed files.
#include "bake/io/ply_reader.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "bake/bake_fixtures.h"
#include "bake/surface_fixtures.h"

namespace jalousie::bake {
namespace {

using test::bytesOf;
using test::codeOf;

TriangleMesh onlyPartOf(const std::string& text) {
  Notes notes;
  return test::onlyPart(readPly(bytesOf(text), "test.ply", notes));
}

const std::string kHeader =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kQuad = kHeader + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

template <class T>
void put(std::string& out, T value, bool bigEndian) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (bigEndian) std::reverse(raw, raw + sizeof(T));
  out.append(raw, sizeof(T));
}

/// Two triangles with a double, a colour and an element to skip.
std::string binaryPly(bool bigEndian) {
  std::string text =
      std::string("ply\nformat binary_") + (bigEndian ? "big" : "little") +
      "_endian 1.0\nelement camera 1\nproperty list short float lens\nelement vertex 4\nproperty double x\n"
      "property float y\nproperty short z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face 2\nproperty uchar flags\nproperty list uint ushort vertex_index\nend_header\n";
  put<std::int16_t>(text, 2, bigEndian);
  put<float>(text, 1.0F, bigEndian);
  put<float>(text, 2.0F, bigEndian);
  for (int v = 0; v < 4; ++v) {
    put<double>(text, v & 1, bigEndian);
    put<float>(text, static_cast<float>(v >> 1), bigEndian);
    put<std::int16_t>(text, -5, bigEndian);
    for (int c = 0; c < 3; ++c)
      put<std::uint8_t>(text, 255, bigEndian);
  }
  for (const std::array<std::uint16_t, 3> face : {std::array<std::uint16_t, 3>{0, 1, 2}, {1, 3, 2}}) {
    put<std::uint8_t>(text, 7, bigEndian);
    put<std::uint32_t>(text, 3, bigEndian);
    for (const std::uint16_t index : face)
      put<std::uint16_t>(text, index, bigEndian);
  }
  return text;
}

TEST(PlyReader, AsciiPolygonsBecomeFans) {
  const TriangleMesh mesh = onlyPartOf(kQuad);
  EXPECT_EQ(mesh.positions.size(), 4U);
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_TRUE(mesh.normals.empty());
}

TEST(PlyReader, BothByteOrdersGiveTheSameMesh) {
  const TriangleMesh little = onlyPartOf(binaryPly(false));
  const TriangleMesh big = onlyPartOf(binaryPly(true));
  EXPECT_EQ(little.positions, big.positions);
  EXPECT_EQ(little.indices, big.indices);
  EXPECT_EQ(little.positions[3], glm::vec3(1, 1, -5));
  ASSERT_EQ(little.colors.size(), 4U);
  EXPECT_EQ(little.colors[0], glm::vec4(1.0F));
}

/// A triangle whose first vertex has this red, of this type.
std::string redPly(const std::string& type, const std::string& red) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty " +
         type + " red\nproperty " + type + " green\nproperty " + type +
         " blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " + red +
         " 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n";
}

TEST(PlyReader, ColoursAreSharesOfTheirTypesFullColour) {
  for (const auto& [type, full] : {std::pair("float", "1"),
                                   {"double", "1.0005"},
                                   {"uchar", "255"},
                                   {"int", "255"},
                                   {"uint", "255"},
                                   {"ushort", "65535"}})
    EXPECT_EQ(onlyPartOf(redPly(type, full)).colors.at(0), glm::vec4(1, 0, 0, 1)) << type;
  EXPECT_NEAR(onlyPartOf(redPly("float", "0.5")).colors.at(0).r, 0.214F, 1e-3F);
  EXPECT_EQ(onlyPartOf(redPly("float", "-1e-6")).colors.at(0).r, 0.0F);
  // Bytes that are written as floats.
  EXPECT_EQ(onlyPartOf(redPly("float", "255")).colors.at(0), glm::vec4(1, 0, 0, 1));
  EXPECT_NEAR(onlyPartOf(redPly("double", "128")).colors.at(0).r, 0.216F, 1e-3F);
}

TEST(PlyReader, ColoursOutOfRangeAreRefusedWithTheValue) {
  for (const auto& [type, red] : {std::pair("float", "300"),
                                  {"float", "1.01"},
                                  {"double", "127.5"},
                                  {"float", "-3"},
                                  {"double", "1e30"},
                                  {"char", "-1"},
                                  {"int", "256"},
                                  {"ushort", "-900"}}) {
    try {
      onlyPartOf(redPly(type, red));
      ADD_FAILURE() << type << " " << red;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kMalformed);
      EXPECT_NE(std::string(error.what()).find("colour"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("outside [0, "), std::string::npos) << error.what();
    }
  }
}

TEST(PlyReader, WindowsLineEndsAndAMissingLastOneAreAccepted) {
  std::string text;
  for (const char c : kQuad) {
    if (c == '\n') text += '\r';
    text += c;
  }
  text.resize(text.size() - 2);
  EXPECT_EQ(onlyPartOf(text).indices.size(), 6U);
}

TEST(PlyReader, HostileFilesAreRefusedByCode) {
  struct Case {
    const char* name;
    std::string text;
    ErrorCode code;
  };
  const auto header = [](const std::string& from, const std::string& to) {
    std::string text = kQuad;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  const std::vector<Case> cases = {
      {"empty", "", ErrorCode::kMalformed},
      {"wrong magic", "plx\n", ErrorCode::kMalformed},
      {"header without end", "ply\nformat ascii 1.0\n", ErrorCode::kMalformed},
      {"no format", header("format ascii 1.0\n", ""), ErrorCode::kMalformed},
      {"unknown format", header("ascii", "morse"), ErrorCode::kMalformed},
      {"negative count", header("vertex 4", "vertex -4"), ErrorCode::kMalformed},
      {"huge count", header("vertex 4", "vertex 99999999999"), ErrorCode::kLimit},
      {"count larger than the file", header("vertex 4", "vertex 200000000"), ErrorCode::kMalformed},
      {"count that is no number", header("vertex 4", "vertex four"), ErrorCode::kMalformed},
      {"property without element", header("element vertex 4\n", ""), ErrorCode::kMalformed},
      {"unknown type", header("property float x", "property quad x"), ErrorCode::kMalformed},
      {"no x", header("property float x", "property float a"), ErrorCode::kMalformed},
      {"x twice", header("property float y", "property float x"), ErrorCode::kMalformed},
      {"float list count", header("list uchar", "list float"), ErrorCode::kMalformed},
      {"index out of range", header("4 0 1 2 3", "4 0 1 2 4"), ErrorCode::kMalformed},
      {"negative index", header("4 0 1 2 3", "4 0 1 2 -1"), ErrorCode::kMalformed},
      {"fractional index", header("4 0 1 2 3", "4 0 1 2 2.5"), ErrorCode::kMalformed},
      {"polygon too large", header("4 0 1 2 3", "99999 0 1 2 3"), ErrorCode::kMalformed},
      {"truncated", kQuad.substr(0, kQuad.size() - 4), ErrorCode::kMalformed},
      {"not a number", header("1 1 0\n", "1 one 0\n"), ErrorCode::kMalformed},
      {"NaN", header("1 1 0\n", "1 nan 0\n"), ErrorCode::kMalformed},
      {"infinite", header("1 1 0\n", "1 inf 0\n"), ErrorCode::kMalformed},
      {"beyond float", header("1 1 0\n", "1 1e300 0\n"), ErrorCode::kMalformed},
      {"no faces", header("4 0 1 2 3", "0"), ErrorCode::kMalformed},
      {"faces without vertices", header("vertex 4", "corner 4"), ErrorCode::kMalformed},
      {"unknown keyword", header("comment", "command"), ErrorCode::kMalformed},
  };
  for (const Case& c : cases)
    EXPECT_EQ(codeOf([&] { onlyPartOf(c.text); }), c.code) << c.name;
}

/// Any damage gives an Error or a mesh that is in range; the sanitizer build watches the rest.
void expectErrorOrValid(const std::string& text) {
  try {
    const TriangleMesh mesh = onlyPartOf(text);
    for (const std::uint32_t index : mesh.indices)
      ASSERT_LT(index, mesh.positions.size());
  } catch (const Error&) {
  }
}

TEST(PlyReader, EveryTruncationAndEveryByteFlipIsAnErrorOrAValidMesh) {
  for (const std::string& file : {kQuad, binaryPly(false), binaryPly(true)}) {
    for (std::size_t length = 0; length < file.size(); ++length)
      expectErrorOrValid(file.substr(0, length));
    for (std::size_t at = 0; at < file.size(); ++at) {
      for (const int flip : {0x01, 0x10, 0x80, 0xff}) {
        std::string damaged = file;
        damaged[at] = static_cast<char>(damaged[at] ^ flip);
        expectErrorOrValid(damaged);
      }
    }
  }
}

TEST(PlyReader, FacesMayComeBeforeVertices) {
  const TriangleMesh mesh = onlyPartOf(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 4\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n");
  EXPECT_EQ(mesh.indices.size(), 6U);
  EXPECT_NEAR(test::areaOf(mesh), 1.0, 1e-6);
}

TEST(PlyReader, WhatIsPassedOverIsNoted) {
  Notes notes;
  readPly(bytesOf("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                  "property float quality\nelement face 2\nproperty list uchar int vertex_indices\nproperty int label\n"
                  "end_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2 5\n2 0 1 5\n"),
          "x.ply", notes);
  EXPECT_EQ(notes.lines(), (std::vector<std::string>{"properties of PLY vertices are left out: quality",
                                                     "properties of PLY faces are left out: label",
                                                     "PLY faces of fewer than three corners are left out: 1 faces"}));
}

TEST(PlyReader, FacesOfTooManyCornersAreLeftOut) {
  const auto file = [](int corners) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n" +
        std::to_string(corners);
    for (int i = 0; i < corners; ++i)
      text += " " + std::to_string(i % 3);
    return text + "\n";
  };
  Notes notes;
  EXPECT_EQ(readPly(bytesOf(file(4097)), "x.ply", notes).faces.size(), 1U);
  EXPECT_EQ(notes.lines(), std::vector<std::string>{"PLY faces of over 4096 corners are left out: 1 faces"});
  EXPECT_EQ(readPly(bytesOf(file(4096)), "x.ply", notes).faces.size(), 2U);
}

TEST(PlyReader, FacesHaveTextureCoordinatesAndPictures) {
  const std::string text =
      "ply\nformat ascii 1.0\ncomment TextureFile wood.png\ncomment TextureFile old stone.png\nelement vertex 4\n"
      "property float x\nproperty float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nproperty int texnumber\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
      "3 0 1 2 6 0 0 1 0 1 1 0\n3 0 2 3 6 0 0.25 1 0 0.5 0.5 1\n";
  Notes notes;
  const PolygonMesh mesh = readPly(bytesOf(text), "x.ply", notes);
  ASSERT_EQ(mesh.materials.size(), 2U);
  EXPECT_EQ(mesh.materials[1].baseColorPicture, "old stone.png");
  const std::vector<SurfaceObject> objects = buildObjects(mesh, NormalRule::kNone);
  ASSERT_EQ(objects[0].parts.size(), 2U);
  EXPECT_EQ(objects[0].parts[0].material, 0);
  EXPECT_EQ(objects[0].parts[0].mesh.uvs[2], glm::vec2(1, 0));  // v runs downwards in glTF
  EXPECT_EQ(objects[0].parts[1].mesh.uvs[0], glm::vec2(0, 0.75F));
}

TEST(PlyReader, StripsBecomeTrianglesOfOneWinding) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n9 0 1 2 3 -1 2 3 4 5\n";
  const TriangleMesh mesh = onlyPartOf(text);
  ASSERT_EQ(mesh.indices.size(), 12U);
  for (std::size_t i = 0; i < 12; i += 3) {
    const glm::vec3 first = mesh.positions[mesh.indices[i]];
    const glm::vec3 normal =
        glm::cross(mesh.positions[mesh.indices[i + 1]] - first, mesh.positions[mesh.indices[i + 2]] - first);
    EXPECT_GT(normal.z, 0.5F);
  }
  std::string bad = text;
  bad.replace(bad.rfind("-1"), 2, "-2");
  EXPECT_EQ(codeOf([&] { onlyPartOf(bad); }), ErrorCode::kMalformed);
}

TEST(PlyReader, ColoursHaveOtherNamesToo) {
  for (const char* prefix : {"", "diffuse_"}) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    for (const char* channel : {"red", "green", "blue"})
      text += std::string("property uchar ") + prefix +
              (*prefix == '\0' ? std::string(channel).substr(0, 1) : channel) + "\n";
    text += "element face 1\nproperty list uchar int vertex_index\nend_header\n";
    text += "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n";
    const TriangleMesh mesh = onlyPartOf(text);
    ASSERT_EQ(mesh.colors.size(), 3U) << prefix;
    EXPECT_EQ(mesh.colors[1], glm::vec4(1, 0, 0, 1));
  }
}

TEST(PlyReader, ConcavePolygonsKeepTheirArea) {
  std::string text = kHeader + "0 0 0\n2 0 0\n0.5 0.5 0\n0 2 0\n4 3 0 1 2\n";
  EXPECT_NEAR(test::areaOf(onlyPartOf(text)), 1.0, 1e-6);
}

}  // namespace
}  // namespace jalousie::bake
