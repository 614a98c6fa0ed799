// Documents compressed with Draco: what comes back, and what must be refused.
#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "asset/accessor.h"
#include "asset/asset_fixtures.h"
#include "asset/scene_file.h"
#include "core/error.h"
#include "support/draco_document.h"

namespace jalousie::asset {
namespace {

using nlohmann::json;
using test::DracoMethod;
using test::DracoSheet;

constexpr std::uint64_t kMost = 10000;

tinygltf::Model parse(const json& document, const std::string& stream) {
  const std::string bytes = test::glb(document.dump(), stream);
  return parseGltf(std::as_bytes(std::span(bytes.data(), bytes.size())), "draco.glb");
}

/// Code and message with which a document is refused; 0 and nothing if it is read.
std::pair<int, std::string> refusal(const json& document, const std::string& stream) {
  try {
    checkScene(parse(document, stream), "draco.glb");
  } catch (const Error& error) {
    return {static_cast<int>(error.code()), error.what()};
  }
  return {0, ""};
}

/// A triangle with its smallest corner first.
glm::uvec3 rotated(glm::uvec3 t) {
  while (t.x > t.y || t.x > t.z)
    t = {t.y, t.z, t.x};
  return t;
}

void sortTriangles(std::vector<glm::uvec3>& triangles) {
  std::sort(triangles.begin(), triangles.end(), [](const glm::uvec3& a, const glm::uvec3& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  });
}

class GltfDraco : public testing::TestWithParam<DracoMethod> {
 protected:
  const DracoSheet sheet_ = test::dracoSheet(20);
  const std::string stream_ = test::dracoStream(sheet_, GetParam());
  json document_ = test::dracoDocument(sheet_, stream_);
  json& primitive() { return document_["meshes"][0]["primitives"][0]; }
  json& extension() { return primitive()["extensions"]["KHR_draco_mesh_compression"]; }
};

INSTANTIATE_TEST_SUITE_P(Methods, GltfDraco, testing::Values(DracoMethod::kSequential, DracoMethod::kEdgebreaker));

TEST_P(GltfDraco, EveryVertexAndTriangleComesBack) {
  const tinygltf::Model model = parse(document_, stream_);
  EXPECT_TRUE(model.extensionsUsed.empty());
  EXPECT_TRUE(model.extensionsRequired.empty());
  const tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
  EXPECT_TRUE(primitive.extensions.empty());
  const auto at = [&](const char* name) { return primitive.attributes.at(name); };
  const std::vector<glm::vec3> positions = readVec3(model, at("POSITION"), kMost);
  const std::vector<glm::vec3> normals = readVec3(model, at("NORMAL"), kMost);
  const std::vector<glm::vec2> uvs = readVec2(model, at("TEXCOORD_0"), kMost);
  const std::vector<glm::vec4> colors = readVec4(model, at("COLOR_0"), kMost);
  const std::vector<float> numbers = readScalars(model, at("_NUMBER"), kMost);
  ASSERT_EQ(numbers.size(), sheet_.positions.size());
  std::vector<bool> isSeen(numbers.size(), false);
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    const auto v = static_cast<std::size_t>(numbers[p]);
    ASSERT_LT(v, isSeen.size());
    isSeen[v] = true;
    EXPECT_LT(glm::distance(positions[p], sheet_.positions[v]), 1.0F / (1 << 13));
    EXPECT_LT(glm::distance(normals[p], sheet_.normals[v]), 0.002F);
    EXPECT_LT(glm::distance(uvs[p], sheet_.uvs[v]), 1.0F / (1 << 11));
    EXPECT_LT(glm::distance(255.0F * colors[p], glm::vec4(sheet_.colors[v])), 0.01F);
  }
  EXPECT_EQ(std::count(isSeen.begin(), isSeen.end(), true), static_cast<std::ptrdiff_t>(isSeen.size()));
  const std::vector<std::uint32_t> indices = readIndices(model, primitive.indices, 441, kMost);
  std::vector<glm::uvec3> triangles;
  for (std::size_t i = 0; i < indices.size(); i += 3)
    triangles.push_back(rotated({numbers[indices[i]], numbers[indices[i + 1]], numbers[indices[i + 2]]}));
  std::vector<glm::uvec3> expected;
  for (const glm::uvec3& t : sheet_.triangles)
    expected.push_back(rotated(t));
  sortTriangles(triangles);
  sortTriangles(expected);
  EXPECT_EQ(triangles, expected);
}

TEST_P(GltfDraco, BoundsAreThoseOfTheDecodedValues) {
  const tinygltf::Model model = parse(document_, stream_);
  const int accessor = model.meshes[0].primitives[0].attributes.at("POSITION");
  float low = 1.0F;
  float high = -1.0F;
  for (const glm::vec3& p : readVec3(model, accessor, kMost)) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  EXPECT_EQ(static_cast<float>(model.accessors[static_cast<std::size_t>(accessor)].minValues.at(2)), low);
  EXPECT_EQ(static_cast<float>(model.accessors[static_cast<std::size_t>(accessor)].maxValues.at(2)), high);
}

TEST_P(GltfDraco, PrimitivesShareAStreamAndKeepTheirOwn) {
  document_["meshes"].push_back(document_["meshes"][0]);  // the same accessors and stream
  const DracoSheet other = test::dracoSheet(20);
  document_["meshes"].push_back(document_["meshes"][0]);  // the same accessors, another view
  document_["bufferViews"].push_back(document_["bufferViews"][0]);
  document_["meshes"][2]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = 1;
  const tinygltf::Model model = parse(document_, stream_);
  const auto position = [&](std::size_t mesh) { return model.meshes[mesh].primitives[0].attributes.at("POSITION"); };
  EXPECT_EQ(position(0), 0);
  EXPECT_EQ(position(1), 0);
  EXPECT_NE(position(2), 0);
  EXPECT_EQ(readVec3(model, position(2), kMost), readVec3(model, 0, kMost));
  EXPECT_EQ(model.buffers.size(), 3U) << "the second mesh was decoded again";
}

TEST_P(GltfDraco, WhatTheAccessorsSayMustFit) {
  const std::vector<std::tuple<const char*, std::function<void(json&, json&)>, ErrorCode, const char*>> cases = {
      {"more vertices",
       [](json& d, json&) {
         for (int i = 0; i < 5; ++i)
           d["accessors"][i]["count"] = 442;
       },
       ErrorCode::kMalformed, "441 vertices in the stream, 442 in the accessors"},
      {"fewer triangles", [](json& d, json&) { d["accessors"][5]["count"] = 2397; }, ErrorCode::kMalformed,
       "800 triangles in the stream, 799 in the accessors"},
      {"accessors that differ", [](json& d, json&) { d["accessors"][1]["count"] = 440; }, ErrorCode::kMalformed,
       "its accessors differ in their number of vertices"},
      {"a million vertices",
       [](json& d, json&) {
         for (int i = 0; i < 5; ++i)
           d["accessors"][i]["count"] = 100000000;
       },
       ErrorCode::kLimit, "bytes are more than the file may unfold to"},
      {"an id that is absent", [](json&, json& e) { e["attributes"]["NORMAL"] = 4; }, ErrorCode::kMalformed,
       "the data has no attribute 4"},
      {"an id that is no number", [](json&, json& e) { e["attributes"]["NORMAL"] = "3"; }, ErrorCode::kMalformed,
       "the number of NORMAL is none"},
      {"a name that is absent", [](json&, json& e) { e["attributes"]["TANGENT"] = 3; }, ErrorCode::kMalformed,
       "the primitive has no attribute TANGENT"},
      {"another type", [](json& d, json&) { d["accessors"][2]["type"] = "VEC3"; }, ErrorCode::kMalformed,
       "attribute 12 has 2 components, accessor 2 has 3"},
      {"numbers above a byte", [](json& d, json&) { d["accessors"][4]["componentType"] = 5121; }, ErrorCode::kMalformed,
       "attribute 9 has values that accessor 4 cannot hold"},
      {"corners above a byte", [](json& d, json&) { d["accessors"][5]["componentType"] = 5121; }, ErrorCode::kMalformed,
       "a triangle has a vertex that the accessor cannot hold"},
      {"a view out of range", [](json&, json& e) { e["bufferView"] = 9; }, ErrorCode::kMalformed,
       "buffer view 9 is out of range, there are 1"},
      {"no view", [](json&, json& e) { e.erase("bufferView"); }, ErrorCode::kMalformed,
       "buffer view null is out of range"},
      {"a view outside of its buffer", [](json& d, json&) { d["bufferViews"][0]["byteOffset"] = 8; },
       ErrorCode::kMalformed, "its view lies outside of its buffer"},
      {"no object", [](json&, json& e) { e = 3; }, ErrorCode::kMalformed, "not an object"},
      {"strips", [](json& d, json&) { d["meshes"][0]["primitives"][0]["mode"] = 5; }, ErrorCode::kUnsupported,
       "triangle strips cannot be read"},
      {"no indices", [](json& d, json&) { d["meshes"][0]["primitives"][0].erase("indices"); }, ErrorCode::kMalformed,
       "the primitive has no indices"},
  };
  for (const auto& [name, change, code, reason] : cases) {
    json document = document_;
    change(document, document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]);
    const auto [found, message] = refusal(document, stream_);
    EXPECT_EQ(found, static_cast<int>(code)) << name;
    EXPECT_NE(message.find(reason), std::string::npos) << name << ": " << message;
  }
}

TEST_P(GltfDraco, TheHeaderOfTheStreamIsChecked) {
  const auto reasonWith = [&](std::size_t at, char value) {
    std::string stream = stream_;
    stream[at] = value;
    return refusal(document_, stream).second;
  };
  EXPECT_NE(reasonWith(0, 'd').find("the data has no header of Draco"), std::string::npos);
  EXPECT_NE(reasonWith(5, 1).find("version 1.2 of the bitstream, only 2.2 is read"), std::string::npos);
  EXPECT_NE(reasonWith(7, 0).find("the data is no mesh"), std::string::npos);
  EXPECT_NE(reasonWith(8, 2).find("the data has an unknown method"), std::string::npos);
}

TEST_P(GltfDraco, EveryTruncationIsRefused) {
  for (std::size_t length = 1; length < stream_.size(); ++length) {
    json document = document_;
    document["buffers"][0]["byteLength"] = length;
    document["bufferViews"][0]["byteLength"] = length;
    const auto [code, message] = refusal(document, stream_.substr(0, length));
    EXPECT_EQ(code, static_cast<int>(ErrorCode::kMalformed)) << length << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST_P(GltfDraco, EveryFlippedBitIsReadOrRefused) {
  const DracoSheet sheet = test::dracoSheet(5);
  const std::string whole = test::dracoStream(sheet, GetParam());
  const json document = test::dracoDocument(sheet, whole);
  int refused = 0;
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string stream = whole;
    stream[bit / 8] = static_cast<char>(stream[bit / 8] ^ (1 << (bit % 8)));
    refused += refusal(document, stream).first != 0 ? 1 : 0;
  }
  EXPECT_GT(refused, 0);
}

TEST_P(GltfDraco, UncompressedDataBesideItStays) {
  for (std::size_t i = 0; i < 6; ++i) {
    document_["accessors"][i]["bufferView"] = 1;
  }
  const std::size_t bytes = 32768;
  document_["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", (stream_.size() + 3) / 4 * 4}, {"byteLength", bytes}});
  const std::string all = stream_ + std::string((stream_.size() + 3) / 4 * 4 - stream_.size() + bytes, '\0');
  document_["buffers"][0]["byteLength"] = all.size();
  const tinygltf::Model model = parse(document_, all);
  EXPECT_EQ(model.buffers.size(), 1U);
  EXPECT_EQ(readVec3(model, 0, kMost), std::vector<glm::vec3>(sheet_.positions.size(), glm::vec3(0.0F)));
}

}  // namespace
}  // namespace jalousie::asset
