// The OBJ reader: materials, polygons, hostile input.
#include "bake/obj_reader.h"

#include <gtest/gtest.h>

#include <fstream>

#include "bake/bake_fixtures.h"
#include "support/run_program.h"

namespace jalousie::bake {
namespace {

using test::codeOf;
using test::bytesOf;

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
  for (const char* text :
       {"", "v 0 0 0\n", "f 1 2 3\n", "v 0 0 0\nf 1 2 3\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/7 2/7 3/7\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//4 2//4 3//4\n", "\x01\x02\x03", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"})
    EXPECT_EQ(codeOf([&] { readObj(bytesOf(text), "x.obj"); }), ErrorCode::kMalformed) << text;
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
