// Quantised and compressed documents: what comes back, and what must be refused.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "asset/asset_fixtures.h"
#include "asset/gltf_quantize.h"
#include "asset/lod_chain.h"
#include "asset/scene_file.h"
#include "core/random.h"

namespace jalousie::asset {
namespace {

using nlohmann::json;
using test::addNode;
using test::codeOf;

/// A bumpy sheet of 2 n^2 triangles around `center`, with every attribute that can be quantised.
int addSheet(tinygltf::Model& model, std::uint32_t n, const glm::vec3& center) {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec4> tangents;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      const glm::vec2 uv(static_cast<float>(x) / static_cast<float>(n), static_cast<float>(y) / static_cast<float>(n));
      positions.push_back(center + glm::vec3(3.0F * uv.x, 5.0F * uv.y, std::sin(6.0F * uv.x)));
      normals.push_back(glm::normalize(glm::vec3(-std::cos(6.0F * uv.x), 0.2F, 1.0F)));
      uvs.push_back(uv);
      tangents.emplace_back(glm::normalize(glm::vec3(1.0F, 0.0F, std::cos(6.0F * uv.x))), x % 2 == 0 ? 1.0F : -1.0F);
      if (x == n || y == n) continue;
      const std::uint32_t v = y * (n + 1) + x;
      indices.insert(indices.end(), {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1});
    }
  }
  constexpr int kTarget = TINYGLTF_TARGET_ARRAY_BUFFER;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = appendVec3(model, positions, kTarget);
  primitive.attributes["NORMAL"] = appendVec3(model, normals, kTarget);
  primitive.attributes["TANGENT"] = appendVec4(model, tangents, kTarget);
  primitive.attributes["TEXCOORD_0"] = appendVec2(model, uvs, kTarget);
  primitive.indices = appendIndices(model, indices);
  tinygltf::Mesh mesh;
  mesh.primitives = {primitive};
  model.meshes.push_back(mesh);
  return static_cast<int>(model.meshes.size()) - 1;
}

/// A moved, turned and stretched parent with a chain of two levels and a child that must not move.
tinygltf::Model chainWithChild() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  addSheet(model, 20, {10, 0, 0});
  addSheet(model, 5, {10, 0, 0});
  addSheet(model, 2, {0, 0, 0});
  setLodInfo(model.meshes[0], {0, 800, 441, 0.0});
  setLodInfo(model.meshes[1], {1, 50, 36, 0.25});
  addNode(model, 0, "sheet");
  addNode(model, 1, "sheet_lod1");
  addNode(model, 2, "child");
  for (const std::size_t n : {0U, 1U}) {
    model.nodes[n].translation = {1, 2, 3};
    model.nodes[n].rotation = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};
    model.nodes[n].scale = {1, 2, 3};
  }
  model.nodes[0].children = {2};
  setLodChain(model, 0, std::vector<int>{1}, std::vector<float>{0.5F, 0.0F});
  test::setScene(model, {0});
  return model;
}

/// World positions of every instance and level of a scene file, in order.
std::vector<std::vector<glm::dvec3>> worldPositions(const SceneFile& scene) {
  std::vector<std::vector<glm::dvec3>> result;
  for (const Instance& instance : scene.instances) {
    for (const LodLevel& level : scene.chains[instance.chain].levels) {
      result.emplace_back();
      for (const Primitive& primitive : scene.meshes[level.mesh].primitives)
        for (const glm::vec3& p : primitive.positions)
          result.back().emplace_back(glm::dmat4(instance.worldFromObject) * glm::dvec4(p, 1.0));
    }
  }
  return result;
}

SceneFile throughFile(const tinygltf::Model& model, const EncodeOptions& options) {
  const test::TempFolder folder;
  saveGlb(model, folder / "file.glb", options);
  return readSceneFile(folder / "file.glb");
}

TEST(Compress, BringsTheSameVerticesAndTrianglesBack) {
  const tinygltf::Model model = chainWithChild();
  const SceneFile plain = throughFile(model, {});
  const SceneFile compressed = throughFile(model, {true});
  ASSERT_EQ(compressed.meshes.size(), plain.meshes.size());
  for (std::size_t m = 0; m < plain.meshes.size(); ++m) {
    const Primitive& a = plain.meshes[m].primitives[0];
    const Primitive& b = compressed.meshes[m].primitives[0];
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.uvs, b.uvs);
    ASSERT_EQ(a.indices.size(), b.indices.size());
    for (std::size_t t = 0; t < a.indices.size(); t += 3) {  // the codec may rotate a triangle
      std::array<std::uint32_t, 3> x = {a.indices[t], a.indices[t + 1], a.indices[t + 2]};
      std::array<std::uint32_t, 3> y = {b.indices[t], b.indices[t + 1], b.indices[t + 2]};
      std::rotate(x.begin(), std::min_element(x.begin(), x.end()), x.end());
      std::rotate(y.begin(), std::min_element(y.begin(), y.end()), y.end());
      ASSERT_EQ(x, y);
    }
  }
  EXPECT_LT(encodeGlb(model, {true}).size(), encodeGlb(model).size());
  EXPECT_EQ(encodeGlb(model, {true}), encodeGlb(model, {true}));
}

TEST(Quantize, MovesNothingFurtherThanTheGridSays) {
  const tinygltf::Model plain = chainWithChild();
  tinygltf::Model small = plain;
  quantizeModel(small);
  EXPECT_EQ(small.extensionsRequired, std::vector<std::string>{"KHR_mesh_quantization"});
  for (const bool compress : {false, true}) {
    const SceneFile before = throughFile(plain, {});
    const SceneFile after = throughFile(small, {compress});
    auto a = worldPositions(before);
    auto b = worldPositions(after);
    // The chain and the child may come in another order.
    const auto bySize = [](const auto& x, const auto& y) { return x.size() > y.size(); };
    std::sort(a.begin(), a.end(), bySize);
    std::sort(b.begin(), b.end(), bySize);
    ASSERT_EQ(a.size(), 3U);
    ASSERT_EQ(b.size(), 3U);
    const double step = 3.0 * 8.0 / 65535.0;  // the cube's side, stretched by 3
    for (std::size_t m = 0; m < a.size(); ++m) {
      ASSERT_EQ(a[m].size(), b[m].size());
      for (std::size_t v = 0; v < a[m].size(); ++v)
        ASSERT_LT(glm::distance(a[m][v], b[m][v]), step) << m << " " << v;
    }
    for (const Mesh& mesh : before.meshes) {
      const Primitive& x = mesh.primitives[0];
      const auto same = std::find_if(after.meshes.begin(), after.meshes.end(), [&](const Mesh& other) {
        return other.primitives[0].positions.size() == x.positions.size();
      });
      ASSERT_NE(same, after.meshes.end());
      const Primitive& y = same->primitives[0];
      for (std::size_t v = 0; v < x.normals.size(); ++v) {
        EXPECT_GT(glm::dot(glm::normalize(x.normals[v]), glm::normalize(y.normals[v])), std::cos(0.4 * 3.14159 / 180));
        EXPECT_LT(glm::distance(x.uvs[v], y.uvs[v]), 1e-4F);
      }
    }
  }
  EXPECT_LT(encodeGlb(small).size(), encodeGlb(plain).size());
}

TEST(Quantize, ErrorsFollowIntoTheNewObjectSpace) {
  tinygltf::Model model = chainWithChild();
  quantizeModel(model);
  const double side = model.nodes.back().scale.empty() ? 1.0 : model.nodes[3].scale[0];
  const auto info = lodInfo(model.meshes[1]);
  ASSERT_TRUE(info.has_value());
  EXPECT_GT(info->errorObject * side, 0.25);
  EXPECT_LT(info->errorObject * side, 0.25 + 2.0 * side / 65535.0);
  EXPECT_EQ(lodInfo(model.meshes[0])->errorObject, 0.0);
}

TEST(Quantize, LeavesInstancedPositionsAndForeignMeshesAlone) {
  tinygltf::Model model = chainWithChild();
  model.nodes[0].extensions["EXT_mesh_gpu_instancing"] = tinygltf::Value(tinygltf::Value::Object{
      {"attributes",
       tinygltf::Value(tinygltf::Value::Object{
           {"TRANSLATION", tinygltf::Value(appendVec3(model, std::vector<glm::vec3>{{0, 0, 0}, {9, 0, 0}}, 0))}})}});
  model.meshes[2].primitives[0].mode = TINYGLTF_MODE_LINE;
  const tinygltf::Mesh lines = model.meshes[2];
  quantizeModel(model);
  const auto componentOf = [&](const char* name) {
    return model.accessors[static_cast<std::size_t>(model.meshes[0].primitives[0].attributes.at(name))].componentType;
  };
  EXPECT_EQ(componentOf("POSITION"), TINYGLTF_COMPONENT_TYPE_FLOAT);
  EXPECT_EQ(componentOf("NORMAL"), TINYGLTF_COMPONENT_TYPE_BYTE);
  EXPECT_TRUE(model.meshes[2] == lines);
  EXPECT_EQ(model.nodes[0].mesh, 0);
}

/// JSON and binary chunk of a compressed file.
struct CompressedFile {
  json document;
  std::string binary;
};

CompressedFile compressedFile() {
  const std::vector<std::byte> bytes = encodeGlb(chainWithChild(), {true});
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::uint32_t length = 0;
  std::memcpy(&length, text.data() + 12, 4);
  return {json::parse(text.substr(20, length)), text.substr(28 + length)};
}

std::optional<ErrorCode> load(const CompressedFile& file, const Limits& limits = {}) {
  const test::TempFolder folder;
  const auto path = folder.write("hostile.glb", test::glb(file.document.dump(), file.binary));
  return codeOf([&] { readSceneFile(path, limits); });
}

TEST(CompressedHostile, EveryBrokenNumberIsRefused) {
  ASSERT_EQ(load(compressedFile()), std::nullopt);
  const auto patched = [](const char* key, const json& value, bool triangles = false) {
    CompressedFile file = compressedFile();
    for (json& view : file.document["bufferViews"]) {
      if (!view.contains("extensions")) continue;
      json& extension = view["extensions"]["EXT_meshopt_compression"];
      if ((extension["mode"] == "TRIANGLES") != triangles) continue;
      extension[key] = value;
      break;
    }
    return load(file);
  };
  for (const char* key : {"buffer", "byteLength", "byteStride", "count"}) {
    EXPECT_EQ(patched(key, -1), ErrorCode::kMalformed) << key;
    EXPECT_EQ(patched(key, 1e30), ErrorCode::kMalformed) << key;
    EXPECT_EQ(patched(key, "x"), ErrorCode::kMalformed) << key;
    EXPECT_EQ(patched(key, nullptr), ErrorCode::kMalformed) << key;
    EXPECT_EQ(patched(key, 7), ErrorCode::kMalformed) << key;
    EXPECT_EQ(patched(key, 1ULL << 62U), ErrorCode::kMalformed) << key;
  }
  EXPECT_EQ(patched("buffer", 1), ErrorCode::kMalformed);  // the stand-in has no data
  EXPECT_EQ(patched("byteOffset", 1ULL << 40U), ErrorCode::kMalformed);
  EXPECT_EQ(patched("mode", "SOMETHING"), ErrorCode::kMalformed);
  EXPECT_EQ(patched("mode", "TRIANGLES"), ErrorCode::kMalformed);
  EXPECT_EQ(patched("mode", 3), ErrorCode::kMalformed);
  EXPECT_EQ(patched("filter", "QUATERNION"), ErrorCode::kMalformed);
  EXPECT_EQ(patched("filter", "SOMETHING"), ErrorCode::kMalformed);
  EXPECT_EQ(patched("filter", "EXPONENTIAL", true), ErrorCode::kMalformed);
  EXPECT_EQ(patched("byteStride", 8, true), ErrorCode::kMalformed);
  CompressedFile notObject = compressedFile();
  notObject.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = 5;
  EXPECT_EQ(load(notObject), ErrorCode::kMalformed);
  CompressedFile uncovered = compressedFile();  // a view on the stand-in that is not compressed
  for (json& view : uncovered.document["bufferViews"])
    if (view.contains("extensions")) view.erase("extensions");
  EXPECT_EQ(load(uncovered), ErrorCode::kMalformed);
}

TEST(CompressedHostile, UnfoldingIsBounded) {
  Limits limits;
  limits.maxFileBytes = 25000;
  CompressedFile file = compressedFile();
  ASSERT_LT(file.document.dump().size() + file.binary.size(), limits.maxFileBytes);
  EXPECT_EQ(load(file, limits), ErrorCode::kLimit);
}

TEST(CompressedHostile, FlippedAndMissingBytesNeverDoHarm) {
  const CompressedFile good = compressedFile();
  Random random(11);
  for (int i = 0; i < 400; ++i) {
    CompressedFile bad = good;
    const std::uint32_t flips = 1 + random.below(4);
    for (std::uint32_t k = 0; k < flips; ++k)
      bad.binary[random.below(static_cast<std::uint32_t>(bad.binary.size()))] ^=
          static_cast<char>(1 + random.below(255));
    const auto code = load(bad);  // loads with other numbers, or is refused
    EXPECT_TRUE(!code || *code == ErrorCode::kMalformed) << i;
  }
  for (std::size_t size = 0; size < good.binary.size(); size += 97) {
    CompressedFile cut = good;
    cut.binary.resize(size);
    EXPECT_EQ(load(cut), ErrorCode::kMalformed) << size;
  }
}

}  // namespace
}  // namespace jalousie::asset
