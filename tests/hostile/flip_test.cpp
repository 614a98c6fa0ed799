// Every truncation and every flipped bit of one small file of each kind: an error or a valid result, and so for what
// the fuzzers have found.
#include <gtest/gtest.h>

#include <cstring>

#include "asset/gltf_file.h"
#include "bake/io/bake_document.h"
#include "bake/io/import.h"
#include "fuzz/exercise.h"
#include "support/scenes.h"

namespace jalousie {
namespace {

std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::string asciiPly() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 4\n"
         "property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n0 0 1 9 9 "
         "9\n"
         "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
}

std::string binaryPly() {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar uint vertex_indices\nend_header\n";
  const auto append = [&](const void* data, std::size_t size) { text.append(static_cast<const char*>(data), size); };
  for (const float value : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F})
    append(&value, sizeof value);
  for (const auto& face : {std::array{0U, 2U, 1U}, {0U, 1U, 3U}, {1U, 2U, 3U}, {2U, 0U, 3U}}) {
    text += '\3';
    append(face.data(), sizeof face);
  }
  return text;
}

std::string obj() {
  return "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nusemtl a\nf 1/1/1 3/3/1 "
         "2/2/1\n"
         "f 1 2 4\nf 2//1 3//1 4//1\nf -2/2 -4/1 -1/3\n";
}

std::string asciiStl() {
  std::string text = "solid a\n";
  for (const char* corners :
       {"vertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n", "vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\n",
        "vertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\n"})
    text += std::string("facet normal 0 0 0\nouter loop\n") + corners + "endloop\nendfacet\n";
  return text + "endsolid a\n";
}

std::string binaryStl() {
  std::string text(80, ' ');
  const auto append = [&](const void* data, std::size_t size) { text.append(static_cast<const char*>(data), size); };
  const std::uint32_t count = 2;
  append(&count, sizeof count);
  for (const float z : {0.0F, 1.0F}) {
    for (const float value : {0.0F, 0.0F, 1.0F, 0.0F, 0.0F, z, 1.0F, 0.0F, z, 0.0F, 1.0F, z})
      append(&value, sizeof value);
    text.append(2, '\0');
  }
  return text;
}

/// A baked ball: two levels, extras, MSFT_lod.
std::string smallGlb() {
  bake::BakeOptions options;
  options.chain.levels = 2;
  options.chain.samples = 100;
  options.chain.preset = bake::Preset::kDraft;
  tinygltf::Model model = bake::importBytes(bytesOf(test::spherePly(6, 4)), "ball.ply", options.limits);
  bake::bakeDocument(model, options, [](auto, auto, const auto&) {});
  const std::vector<std::byte> bytes = asset::encodeGlb(std::move(model));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Kind {
  const char* name;
  std::string (*text)();
  void (*exercise)(std::span<const std::byte>);
};

class EveryKind : public testing::TestWithParam<Kind> {};

TEST_P(EveryKind, TruncationsBakeOrFail) {
  const std::string text = GetParam().text();
  for (std::size_t size = 0; size <= text.size(); ++size) {
    SCOPED_TRACE(size);
    test::exerciseWholeBake(bytesOf(text.substr(0, size)), GetParam().name);
  }
}

TEST_P(EveryKind, FlippedBitsLoadOrFail) {
  const std::string text = GetParam().text();
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = text;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      GetParam().exercise(bytesOf(damaged));
    }
  }
}

TEST_P(EveryKind, FlippedBytesBakeOrFail) {
  const std::string text = GetParam().text();
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const int flip : {0xFF, 0x10}) {
      std::string damaged = text;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      test::exerciseWholeBake(bytesOf(damaged), GetParam().name);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, EveryKind,
    testing::Values(Kind{"ascii.ply", asciiPly, test::exercisePly}, Kind{"binary.ply", binaryPly, test::exercisePly},
                    Kind{"mesh.obj", obj, test::exerciseObj}, Kind{"ascii.stl", asciiStl, test::exerciseStl},
                    Kind{"binary.stl", binaryStl, test::exerciseStl}, Kind{"mesh.glb", smallGlb, test::exerciseGltf}),
    [](const auto& parameter) {
      std::string name = parameter.param.name;
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

TEST(Exercise, TheUndamagedFilesBake) {
  for (const auto& [name, text] : {std::pair("a.ply", asciiPly()),
                                   {"b.ply", binaryPly()},
                                   {"c.obj", obj()},
                                   {"d.stl", asciiStl()},
                                   {"e.stl", binaryStl()},
                                   {"f.glb", smallGlb()}})
    EXPECT_FALSE(bake::importBytes(bytesOf(text), name, {}).meshes.empty()) << name;
}

}  // namespace
}  // namespace jalousie
