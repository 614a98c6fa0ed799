// The OBJ reader: materials, polygons, untrusted input.
#include "bake/io/obj_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "bake/bake_fixtures.h"
#include "bake/io/import.h"
#include "bake/surface_fixtures.h"
#include "support/run_program.h"

namespace jalousie::bake {
namespace {

using test::bytesOf;
using test::codeOf;

const std::string kTwoQuads =
    "mtllib quads.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nusemtl red\nf 1/1 2/1 3/2 4/2\nusemtl "
    "blue\nf 4 3 2 1\n";

PolygonMesh read(const std::string& text, const std::filesystem::path& file = "x.obj") {
  Notes notes;
  return readObj(bytesOf(text), file, notes);
}

TEST(ObjReader, MaterialsFromTheSameFolderBecomeParts) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "quads.mtl") << "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nd 0.5\n";
  const PolygonMesh mesh = read(kTwoQuads, folder / "quads.obj");
  const std::vector<SurfaceObject> objects = buildObjects(mesh, NormalRule::kNone);
  ASSERT_EQ(objects.size(), 1U);
  ASSERT_EQ(objects[0].parts.size(), 2U);
  EXPECT_EQ(mesh.materials[0].name, "red");
  EXPECT_EQ(mesh.materials[0].baseColor, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(objects[0].parts[0].mesh.indices.size(), 6U);
  EXPECT_EQ(objects[0].parts[0].mesh.uvs.size(), 4U);
  EXPECT_EQ(mesh.materials[1].baseColor.a, 0.5F);
  EXPECT_TRUE(objects[0].parts[1].mesh.uvs.empty());
}

TEST(ObjReader, MaterialsOutsideTheFolderAreNotOpened) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "inner");
  std::ofstream(folder / "quads.mtl") << "newmtl red\nKd 1 0 0\n";
  std::filesystem::create_symlink(folder / "quads.mtl", folder / "inner" / "quads.mtl");
  std::string outside = kTwoQuads;
  outside.replace(outside.find("quads.mtl"), 9, "../quads.mtl");
  for (const std::string& text : {kTwoQuads, outside}) {
    Notes notes;
    const PolygonMesh mesh = readObj(bytesOf(text), folder / "inner/quads.obj", notes);
    EXPECT_EQ(mesh.materials[0].baseColor, glm::vec4(1.0F));
    ASSERT_EQ(notes.lines().size(), 1U);
    EXPECT_NE(notes.lines()[0].find("a material file is missing or cannot be read"), std::string::npos);
  }
}

TEST(ObjReader, AByteOrderMarkIsNoStatement) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "quads.mtl") << "\xEF\xBB\xBFnewmtl red\nKd 0 1 0\n";
  const PolygonMesh mesh =
      read("\xEF\xBB\xBFv 5 0 0\nv 1 0 0\nv 0 1 0\nmtllib quads.mtl\nusemtl red\nf 1 2 3\n", folder / "quads.obj");
  ASSERT_EQ(mesh.positions.size(), 3U);
  EXPECT_EQ(mesh.positions[0], glm::dvec3(5, 0, 0));
  EXPECT_EQ(mesh.materials.at(0).baseColor, glm::vec4(0, 1, 0, 1));
}

TEST(ObjReader, WhatIsPassedOverIsNoted) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "a.mtl") << "newmtl red\nmap_Kd -s 2 3 1 wood.png\n";
  Notes notes;
  readObj(
      bytesOf("# a comment\nmtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\nf 1 2\ncurv2 1 2\n"),
      folder / "a.obj", notes);
  EXPECT_EQ(notes.lines(),
            (std::vector<std::string>{"points and lines of the OBJ file are left out: line 8",
                                      "OBJ faces of fewer than three corners are left out: line 9",
                                      "OBJ statements are passed over: curv2",
                                      "scale, offset and clamping of a texture are left out: wood.png"}));
}

TEST(ObjReader, HostileFilesAreErrors) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const std::string& text :
       {std::string(), std::string("f 1 2 3\n"), std::string("v 0 0 0\nf 1 2 3\n"), std::string("\x01\x02\x03"),
        triangle + "f 1 2 99\n", triangle + "f 1 2 -9\n", triangle + "f 1/7 2/7 3/7\n", triangle + "f 1//4 2//4 3//4\n",
        triangle + "f 0 1 2\n", triangle + "f 1 2 x\n", triangle + "f 1/ 2/ 3/\n", triangle + "f 1 2 9999999999\n",
        "v nan 0 0\n" + triangle + "f 1 2 3\n", "v 0 inf 0\n" + triangle + "f 1 2 3\n",
        "v 0 0\n" + triangle + "f 1 2 3\n", "v 1e39 0 0\n" + triangle + "f 1 2 3\n",
        "v 0 zero 0\n" + triangle + "f 1 2 3\n", triangle + "vt nan\nf 1/1 2/1 3/1\n",
        triangle + "f 1 2 3" + std::string(1, '\0') + "\n"})
    EXPECT_EQ(codeOf([&] { read(text); }), ErrorCode::kMalformed) << text;
}

TEST(ObjReader, PointsAndLinesAreUnsupported) {
  for (const char* text : {"v 0 0 0\n", "v 0 0 0\nv 1 0 0\nl 1 2\np 1\n", "v 0 0 0\nv 1 0 0\nf 1 2\n"})
    EXPECT_EQ(codeOf([&] { read(text); }), ErrorCode::kUnsupported) << text;
}

TEST(ObjReader, PolygonsOfAnySizeAreFans) {
  for (const int corners : {3, 4, 255, 256, 300, 1000}) {
    std::string text;
    std::string face = "f";
    for (int i = 1; i <= corners; ++i) {
      text += fmt::format("v {} {} 0\n", i, i * i);
      face += fmt::format(" {}", i);
    }
    EXPECT_EQ(test::onlyPart(read(text + face + "\n")).indices.size(), 3U * static_cast<unsigned>(corners - 2))
        << corners;
  }
}

TEST(ObjReader, FacesOfTooManyCornersAreLeftOut) {
  std::string circle;
  std::string face = "f";
  for (int i = 1; i <= 4097; ++i) {
    circle += fmt::format("v {} {} 0\n", std::cos(i * 0.0015), std::sin(i * 0.0015));
    face += fmt::format(" {}", i);
  }
  Notes notes;
  const PolygonMesh mesh = readObj(bytesOf(circle + face + "\nf 1 2 3\n"), "a.obj", notes);
  EXPECT_EQ(mesh.faces.size(), 1U);
  EXPECT_EQ(mesh.corners.size(), 3U);
  EXPECT_EQ(notes.lines(), std::vector<std::string>{"OBJ faces of over 4096 corners are left out: line 4098"});
  EXPECT_EQ(codeOf([&] { read(circle + face + "\n"); }), ErrorCode::kUnsupported) << "nothing is left";
  const std::string largest = face.substr(0, face.rfind(' '));
  EXPECT_EQ(read(circle + largest + "\n").corners.size(), 4096U);
}

TEST(ObjReader, ContinuedLinesAndPassedOverStatements) {
  const std::string text =
      "# comment\r\nv 0 0 0 1 0.5 0.5 0.5\r\nv 1 0 \\\r\n 0\r\nv +0 1.0e0 0\r\ng a b\r\ns off\r\nt x 2147483647/1/1\r\n"
      "vw 0 0 0.5\r\nl 1 2\r\nf -3 \\\r\n-2 -1\r\n";
  const TriangleMesh mesh = test::onlyPart(read(text));
  EXPECT_EQ(mesh.positions.size(), 3U);
  EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 0));
}

TEST(ObjReader, EveryTruncationAndByteFlipIsAnErrorOrAValidMesh) {
  const auto check = [](const std::string& text) {
    try {
      for (const SurfaceObject& object : buildObjects(read(text), NormalRule::kCreases))
        for (const SurfacePart& part : object.parts)
          for (const std::uint32_t index : part.mesh.indices)
            ASSERT_LT(index, part.mesh.positions.size());
    } catch (const Error&) {
    }
  };
  for (std::size_t length = 0; length < kTwoQuads.size(); ++length)
    check(kTwoQuads.substr(0, length));
  for (std::size_t at = 0; at < kTwoQuads.size(); ++at) {
    for (const int flip : {0x01, 0x10, 0x80}) {
      std::string damaged = kTwoQuads;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      check(damaged);
    }
  }
}

TEST(ObjReader, ConcavePolygonsKeepTheirArea) {
  const std::string corners = "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n";
  for (const char* face : {"f 1 2 3 4 5 6", "f 2 3 4 5 6 1", "f 6 5 4 3 2 1", "f 4 5 6 1 2 3"})
    EXPECT_NEAR(test::areaOf(test::onlyPart(read(corners + face + "\n"))), 5.0, 1e-6) << face;
}

TEST(ObjReader, ObjectsAreMeshesAndGroupsWhereThereAreNone) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string faces = "g one\nf 1 2 3\ng two words\nf 3 2 1\ng one\nf 2 3 1\n";
  std::vector<SurfaceObject> objects = buildObjects(read(triangle + faces), NormalRule::kNone);
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].name, "one");
  EXPECT_EQ(objects[0].parts[0].mesh.indices.size(), 6U);
  EXPECT_EQ(objects[1].name, "two words");
  objects = buildObjects(read("o whole\n" + triangle + faces), NormalRule::kNone);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].name, "whole");
}

TEST(ObjReader, MissingNormalsFollowSmoothingGroupsOrCreases) {
  // A roof of two squares: 53 degrees between them.
  const std::string roof = "v 0 0 0\nv 0 1 0\nv 2 0 1\nv 2 1 1\nv 4 0 0\nv 4 1 0\n";
  const auto vertices = [&](const std::string& groups) {
    const std::size_t cut = groups.find('|');
    const std::string text = roof + groups.substr(0, cut) + "f 1 3 4 2\n" + groups.substr(cut + 1) + "f 3 5 6 4\n";
    return test::onlyPart(read(text), NormalRule::kCreases).positions.size();
  };
  EXPECT_EQ(vertices("|"), 8U);  // a crease
  EXPECT_EQ(vertices("s 1\n|"), 6U);
  EXPECT_EQ(vertices("s 1\n|s 2\n"), 8U);
  EXPECT_EQ(vertices("s off\n|"), 8U);
}

TEST(ObjReader, CreasesOfACubeAndSmoothnessOfABall) {
  const std::string cube =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const TriangleMesh mesh = test::onlyPart(read(cube), NormalRule::kCreases);
  EXPECT_EQ(mesh.positions.size(), 24U);
  for (const glm::vec3& n : mesh.normals)
    EXPECT_NEAR(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1.0F, 1e-6F);
  std::string ball;
  const asset::Primitive sphere = test::sphere(16, 8);
  for (const glm::vec3& p : sphere.positions)
    ball += fmt::format("v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
  for (std::size_t i = 0; i < sphere.indices.size(); i += 3)
    ball += fmt::format("f {} {} {}\n", sphere.indices[i] + 1, sphere.indices[i + 1] + 1, sphere.indices[i + 2] + 1);
  const TriangleMesh smooth = test::onlyPart(read(ball), NormalRule::kCreases);
  for (std::size_t v = 0; v < smooth.positions.size(); ++v)
    EXPECT_GT(glm::dot(glm::normalize(smooth.positions[v]), smooth.normals[v]), 0.97F);
}

TEST(ObjReader, VertexColoursAreSharesOfOneOrOf255) {
  for (const char* colours : {"1 0.5 0", "255 127.5 0"}) {
    const std::string text = fmt::format("v 0 0 0 {0}\nv 1 0 0 {0}\nv 0 1 0 {0}\nf 1 2 3\n", colours);
    const TriangleMesh mesh = test::onlyPart(read(text));
    ASSERT_EQ(mesh.colors.size(), 3U);
    EXPECT_NEAR(mesh.colors[0].r, 1.0F, 1e-6F);
    EXPECT_NEAR(mesh.colors[0].g, 0.2140F, 1e-3F);  // sRGB 0.5
    EXPECT_EQ(mesh.colors[0].b, 0.0F);
  }
}

TEST(ObjReader, StrayVertexColoursAreClampedAndAbsentOnesWhite) {
  Notes notes;
  const PolygonMesh mesh = readObj(bytesOf("v 0 0 0 1.2 0.5 0\nv 1 0 0 -0.1 1 0\nv 0 1 0\nf 1 2 3\n"), "a.obj", notes);
  ASSERT_EQ(mesh.colors.size(), 3U);
  EXPECT_NEAR(mesh.colors[0].r, 1.0F, 1e-6F);
  EXPECT_NEAR(mesh.colors[0].g, 0.2140F, 1e-3F);
  EXPECT_EQ(mesh.colors[1].r, 0.0F);
  EXPECT_EQ(mesh.colors[2], glm::vec4(1.0F));
  EXPECT_EQ(notes.lines(),
            (std::vector<std::string>{"vertices without a colour become white: 1 of 3",
                                      "vertex colours outside of 0 to 1 are clamped: 1.2 0.5 0 and 1 more"}));
}

TEST(ObjReader, IndicesOutOfRangeNameTheLine) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::pair<const char*, const char*> cases[] = {
      {"f 1 2 3\nf 1 2 9\n", "line 5: a face has an index out of range: vertex 9 of 3"},
      {"f 1/1 2/2 3/3\n", "line 4: a face has an index out of range: texture coordinate 1 of 0"},
      {"f 1//1 2//2 3//3\n", "line 4: a face has an index out of range: normal 1 of 0"}};
  for (const auto& [faces, expected] : cases) {
    try {
      read(vertices + faces);
      ADD_FAILURE() << faces;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
}

TEST(ObjReader, AMaterialWithoutAColourIsWhiteAndStatementsWithoutACounterpartAreNamed) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "a.mtl") << "newmtl plain\nNs 20\nKs 1 1 1\nnewmtl black\nKd 0 0 0\n";
  Notes notes;
  const PolygonMesh mesh =
      readObj(bytesOf("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl plain\nf 1 2 3\nusemtl black\nf 3 2 1\n"),
              folder / "a.obj", notes);
  ASSERT_EQ(mesh.materials.size(), 2U);
  EXPECT_EQ(mesh.materials[0].baseColor, glm::vec4(1.0F));
  EXPECT_EQ(mesh.materials[1].baseColor, glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(notes.lines(),
            (std::vector<std::string>{"MTL statements have no counterpart and are passed over: Ks, Ns"}));
}

TEST(ObjReader, EqualPicturesAreEmbeddedOnceAndThoseOutsideNamed) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.png", "b.png"})
    std::ofstream(folder / name) << "\x89PNG\r\n\x1a\n the same bytes";
  std::ofstream(folder / "a.mtl") << "newmtl red\nmap_Kd a.png\nnewmtl blue\nmap_Kd b.png\n"
                                     "newmtl lost\nmap_Kd ../c.png\n";
  std::ofstream(folder / "a.obj") << "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"
                                     "usemtl blue\nf 2 3 1\nusemtl lost\nf 3 1 2\n";
  Notes notes;
  const tinygltf::Model model = importFiles({folder / "a.obj"}, {}, notes);
  EXPECT_EQ(model.images.size(), 1U);
  EXPECT_EQ(notes.lines(), (std::vector<std::string>{"a picture lies outside of the input's folder: ../c.png"}));
}

TEST(ObjReader, ObjectsFarFromTheOriginShareOneOffset) {
  const std::string text =
      "v 500000 4600000.5 10\nv 500001 4600000.5 10\nv 500000 4600001.5 10\nv 500001 4600001.7 10\n"
      "v 500000.001 4600000.5 10\nv 500000 4600000.501 10\n"
      "o left\nf 1 2 3\no right\nf 3 2 4\no grain\nf 1 5 6\n";
  const std::vector<SurfaceObject> objects = buildObjects(read(text), NormalRule::kNone);
  ASSERT_EQ(objects.size(), 3U);
  EXPECT_NE(objects[0].offset, glm::dvec3(0.0));
  EXPECT_EQ(objects[0].offset, objects[1].offset);
  EXPECT_EQ(objects[0].parts[0].mesh.positions[1], objects[1].parts[0].mesh.positions[1]) << "they touch";
  EXPECT_NE(objects[2].offset, objects[0].offset) << "little would be left of it";
}

TEST(ObjReader, FarFromTheOriginTheOffsetLeavesTheMeshExact) {
  const std::string text =
      "v 500123.0625 4649786.001 10\nv 500124.0625 4649786.001 10\nv 500123.0625 4649787.003 10\nf 1 2 3\n";
  const std::vector<SurfaceObject> objects = buildObjects(read(text), NormalRule::kNone);
  ASSERT_EQ(objects.size(), 1U);
  const std::vector<glm::vec3>& p = objects[0].parts[0].mesh.positions;
  EXPECT_NEAR(glm::distance(p[0], p[2]), 1.002, 1e-6);
  EXPECT_NEAR(objects[0].offset.y + p[0].y, 4649786.001, 1e-6);
  EXPECT_EQ(objects[0].offset, glm::dvec3(glm::vec3(objects[0].offset)));  // exact in single precision
  EXPECT_EQ(buildObjects(read("v 1 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3\n"), NormalRule::kNone)[0].offset, glm::dvec3(0.0));
}

TEST(ObjReader, PicturesAreEmbeddedAndMissingOnesAreNoted) {
  const test::TemporaryFolder folder;
  std::string png = "\x89PNG\r\n\x1a\n";
  png += "the picture is not decoded";
  std::ofstream(folder / "wood.png") << png;
  std::ofstream(folder / "paint.tga") << "no known kind";
  std::ofstream(folder / "quads.mtl") << "newmtl red\nmap_Kd wood.png\nmap_Ke absent.png\n"
                                         "newmtl blue\nKd 0 0 1\nmap_Kd paint.tga\nmap_Bump wood.png\n";
  std::ofstream(folder / "quads.obj") << kTwoQuads;
  Notes notes;
  std::map<std::string, bool> seen;
  const tinygltf::Model model =
      importFiles({folder / "quads.obj"}, {}, notes,
                  [&](std::size_t, const std::string& name, std::optional<std::span<const std::byte>> bytes) {
                    seen[name] = bytes.has_value();
                  });
  ASSERT_EQ(model.materials.size(), 2U);
  ASSERT_EQ(model.images.size(), 1U);
  EXPECT_EQ(std::string(model.images[0].image.begin(), model.images[0].image.end()), png);
  EXPECT_EQ(model.materials[0].pbrMetallicRoughness.baseColorTexture.index, 0);
  EXPECT_EQ(model.materials[0].pbrMetallicRoughness.baseColorFactor, (std::vector<double>{1, 1, 1, 1}));
  EXPECT_EQ(model.materials[1].pbrMetallicRoughness.baseColorTexture.index, -1);
  EXPECT_EQ(notes.lines(), (std::vector<std::string>{"map_bump has no counterpart and is left out: wood.png",
                                                     "a picture is missing or cannot be read: absent.png",
                                                     "a picture that is no PNG, JPEG or WebP is left out: paint.tga"}));
  EXPECT_EQ(seen,
            (std::map<std::string, bool>{
                {"", true}, {"absent.png", false}, {"paint.tga", true}, {"quads.mtl", true}, {"wood.png", true}}));
}

}  // namespace
}  // namespace jalousie::bake
