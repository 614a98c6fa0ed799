// The OBJ reader: materials, polygons, untrusted input.
#include "bake/io/obj_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bake/bake_fixtures.h"
#include "support/run_program.h"

namespace jalousie::bake {
namespace {

using test::bytesOf;
using test::codeOf;

const std::string kTwoQuads =
    "mtllib quads.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nusemtl red\nf 1/1 2/1 3/2 4/2\nusemtl "
    "blue\nf 4 3 2 1\n";

TEST(ObjReader, MaterialsFromTheSameFolderBecomeParts) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "quads.mtl") << "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nd 0.5\n";
  const std::vector<ObjPart> parts = readObj(bytesOf(kTwoQuads), folder / "quads.obj");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].material, "red");
  EXPECT_EQ(parts[0].baseColor, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(parts[0].mesh.indices.size(), 6U);
  EXPECT_EQ(parts[0].mesh.uvs.size(), 4U);
  EXPECT_EQ(parts[1].baseColor.a, 0.5F);
  EXPECT_TRUE(parts[1].mesh.uvs.empty());
}

TEST(ObjReader, MaterialsOutsideTheFolderAreNotOpened) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "inner");
  std::ofstream(folder / "quads.mtl") << "newmtl red\nKd 1 0 0\n";
  std::filesystem::create_symlink(folder / "quads.mtl", folder / "inner" / "quads.mtl");
  std::string outside = kTwoQuads;
  outside.replace(outside.find("quads.mtl"), 9, "../quads.mtl");
  for (const std::string& text : {kTwoQuads, outside})
    EXPECT_TRUE(readObj(bytesOf(text), folder / "inner/quads.obj")[0].material.empty());
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
    EXPECT_EQ(codeOf([&] { readObj(bytesOf(text), "x.obj"); }), ErrorCode::kMalformed) << text;
}

TEST(ObjReader, PointsAndLinesAreUnsupported) {
  for (const char* text : {"v 0 0 0\n", "v 0 0 0\nv 1 0 0\nl 1 2\np 1\n", "v 0 0 0\nv 1 0 0\nf 1 2\n"})
    EXPECT_EQ(codeOf([&] { readObj(bytesOf(text), "x.obj"); }), ErrorCode::kUnsupported) << text;
}

TEST(ObjReader, PolygonsOfAnySizeAreFans) {
  for (const int corners : {3, 4, 255, 256, 300, 1000}) {
    std::string text;
    std::string face = "f";
    for (int i = 1; i <= corners; ++i) {
      text += fmt::format("v {} {} 0\n", i, i * i);
      face += fmt::format(" {}", i);
    }
    const std::vector<ObjPart> parts = readObj(bytesOf(text + face + "\n"), "x.obj");
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].mesh.indices.size(), 3U * static_cast<unsigned>(corners - 2)) << corners;
  }
}

TEST(ObjReader, ContinuedLinesAndPassedOverStatements) {
  const std::string text =
      "# comment\r\nv 0 0 0 1 0.5 0.5 0.5\r\nv 1 0 \\\r\n 0\r\nv +0 1.0e0 0\r\ng a b\r\ns off\r\nt x 2147483647/1/1\r\n"
      "vw 0 0 0.5\r\nl 1 2\r\nf -3 \\\r\n-2 -1\r\n";
  const std::vector<ObjPart> parts = readObj(bytesOf(text), "x.obj");
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].mesh.positions.size(), 3U);
  EXPECT_EQ(parts[0].mesh.positions[1], glm::vec3(1, 0, 0));
}

TEST(ObjReader, EveryTruncationAndByteFlipIsAnErrorOrAValidMesh) {
  const auto check = [](const std::string& text) {
    try {
      for (const ObjPart& part : readObj(bytesOf(text), "x.obj"))
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

}  // namespace
}  // namespace jalousie::bake
