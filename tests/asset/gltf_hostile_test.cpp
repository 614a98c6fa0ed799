// Documents that must be refused: each by the name of what is wrong with it.
#include <sys/stat.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "asset/asset_fixtures.h"
#include "asset/gltf_file.h"
#include "asset/gltf_quantize.h"
#include "asset/scene_file.h"

namespace jalousie::asset {
namespace {

using nlohmann::json;
using test::codeOf;
using test::glb;
using test::TempFolder;

/// A valid document with one triangle in 36 bytes of chunk; tests damage it.
json validDocument() {
  return json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "children": [1]}, {}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "materials": [{}], "textures": [{}], "animations": [], "cameras": []
  })");
}

const std::string kTriangle(36, '\0');

std::optional<ErrorCode> load(const std::string& bytes, const Limits& limits = {}) {
  const TempFolder folder;
  const std::filesystem::path file = folder.write("hostile.glb", bytes);
  return codeOf([&] { readSceneFile(file, limits); });
}

/// What parseGltf says about a document around the triangle; empty if it accepts it.
std::string reasonOf(const json& document, const Limits& limits = {}) {
  const std::string bytes = glb(document.dump(), kTriangle);
  try {
    parseGltf(std::as_bytes(std::span(bytes.data(), bytes.size())), "hostile.glb", limits);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::optional<ErrorCode> loadPatched(const char* pointer, const json& value) {
  json document = validDocument();
  document[json::json_pointer(pointer)] = value;
  return load(glb(document.dump(), kTriangle));
}

TEST(GltfHostile, TheUndamagedDocumentLoads) {
  EXPECT_EQ(load(glb(validDocument().dump(), kTriangle)), std::nullopt);
}

TEST(GltfHostile, EveryTruncationOfAGlbIsRefused) {
  const std::string bytes = glb(validDocument().dump(), kTriangle);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto code = load(bytes.substr(0, size));
    EXPECT_EQ(code, ErrorCode::kMalformed) << size;
  }
}

TEST(GltfHostile, GlbVersionsOtherThanTwo) {
  for (const std::uint32_t version : {0U, 1U, 3U, 0xFFFFFFFFU})
    EXPECT_EQ(load(glb(validDocument().dump(), kTriangle, version)), ErrorCode::kUnsupported) << version;
}

TEST(GltfHostile, GlbLengthsThatLie) {
  const std::string bytes = glb(validDocument().dump(), kTriangle);
  for (const std::size_t offset : {std::size_t{8}, std::size_t{12}}) {
    for (const std::uint32_t value : {0U, 3U, 0x7FFFFFFFU, 0xFFFFFFFFU, 0xFFFFFFFCU}) {
      std::string changed = bytes;
      std::memcpy(changed.data() + offset, &value, 4);
      EXPECT_EQ(load(changed), ErrorCode::kMalformed) << offset << " " << value;
    }
  }
}

TEST(GltfHostile, DeepNestingIsRefusedBeforeParsing) {
  const std::string deep =
      R"({"asset":{"version":"2.0"},"extras":)" + std::string(200'000, '[') + std::string(200'000, ']') + "}";
  EXPECT_EQ(load(deep), ErrorCode::kLimit);
  std::string objects = R"({"asset":{"version":"2.0"},"extras":)";
  for (int i = 0; i < 200'000; ++i)
    objects += R"({"a":)";
  EXPECT_EQ(load(objects), ErrorCode::kLimit);
}

TEST(GltfHostile, NestingMayReachTheLimit) {
  for (const std::size_t depth : {Limits{}.maxJsonDepth, Limits{}.maxJsonDepth + 1}) {
    json document = validDocument();
    json nested = json::array();
    for (std::size_t level = 2; level < depth; ++level)  // the document is the first level
      nested = json::array({nested});
    document["extras"] = nested;
    const std::optional<ErrorCode> expected =
        depth > Limits{}.maxJsonDepth ? std::optional(ErrorCode::kLimit) : std::nullopt;
    EXPECT_EQ(load(glb(document.dump(), kTriangle)), expected) << depth;
  }
}

TEST(GltfHostile, BracketsInStringsAreNoNesting) {
  json document = validDocument();
  document["extras"] = std::string(1000, '[') + "\\\"" + std::string(1000, '{');
  EXPECT_EQ(load(glb(document.dump(), kTriangle)), std::nullopt);
}

TEST(GltfHostile, TooManyElementsAreRefusedBeforeParsing) {
  Limits limits;
  limits.maxJsonElements = 1000;
  std::string many = R"({"asset":{"version":"2.0"},"extras":[0)";
  for (int i = 0; i < 1001; ++i)
    many += ",0";
  EXPECT_EQ(load(many + "]}", limits), ErrorCode::kLimit);
}

TEST(GltfHostile, FileLargerThanTheLimit) {
  Limits limits;
  limits.maxFileBytes = 100;
  EXPECT_EQ(load(glb(validDocument().dump(), kTriangle), limits), ErrorCode::kLimit);
}

TEST(GltfHostile, TextThatIsNoDocument) {
  for (const char* text : {"", "{", "[]", "null", "{}", "\xFF\xFE", R"({"asset":3})", R"({"asset":{"version":2}})",
                           R"({"asset":{"version":"2.0"},"extras":1e999})"})
    EXPECT_EQ(load(text), ErrorCode::kMalformed) << text;
  EXPECT_EQ(load(R"({"asset":{"version":"1.0"}})"), ErrorCode::kUnsupported);
  EXPECT_EQ(load(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"), ErrorCode::kUnsupported);
}

TEST(GltfHostile, UnknownRequiredExtension) {
  EXPECT_EQ(loadPatched("/extensionsRequired", {"ACME_mesh"}), ErrorCode::kUnsupported);
  EXPECT_EQ(loadPatched("/extensionsRequired", {"MSFT_lod", "KHR_materials_unlit"}), std::nullopt);
  for (const char* known : {"KHR_lights_punctual", "KHR_texture_transform", "EXT_mesh_gpu_instancing"})
    EXPECT_EQ(loadPatched("/extensionsRequired", json::array({known})), std::nullopt) << known;
  EXPECT_EQ(loadPatched("/extensionsRequired", {7}), ErrorCode::kMalformed);
}

TEST(GltfHostile, IndicesOutOfRange) {
  for (const char* pointer :
       {"/scene", "/scenes/0/nodes/0", "/nodes/0/mesh", "/nodes/0/children/0", "/nodes/0/camera", "/nodes/0/skin",
        "/meshes/0/primitives/0/attributes/POSITION", "/meshes/0/primitives/0/indices",
        "/meshes/0/primitives/0/material", "/meshes/0/primitives/0/mode", "/bufferViews/0/buffer",
        "/accessors/0/bufferView", "/textures/0/source", "/textures/0/sampler"}) {
    for (const json& value : {json(9), json(-1), json(4294967296), json(1.5), json("0"), json(nullptr)}) {
      EXPECT_EQ(loadPatched(pointer, value), ErrorCode::kMalformed) << pointer << " " << value;
    }
  }
  EXPECT_EQ(loadPatched("/materials/0/pbrMetallicRoughness", {{"baseColorTexture", {{"index", 5}}}}),
            ErrorCode::kMalformed);
}

TEST(GltfHostile, AnimationIndicesOutOfRange) {
  json document = validDocument();
  document["accessors"].push_back(
      json::parse(R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "SCALAR"})"));
  document["animations"] = json::parse(R"([{"channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}],
                                           "samplers":[{"input":1,"output":0}]}])");
  std::string ascending = kTriangle;  // the times are the first three numbers of the positions
  const float times[] = {0.0F, 1.0F, 2.0F};
  std::memcpy(ascending.data(), times, sizeof times);
  EXPECT_EQ(load(glb(document.dump(), ascending)), std::nullopt);
  for (const char* pointer :
       {"/channels/0/sampler", "/channels/0/target/node", "/samplers/0/input", "/samplers/0/output"}) {
    json bad = document;
    bad["animations"][0][json::json_pointer(pointer)] = 7;
    EXPECT_EQ(load(glb(bad.dump(), ascending)), ErrorCode::kMalformed) << pointer;
  }
}

TEST(GltfHostile, AnAnimationWithoutATarget) {  // found by the glTF fuzzer: it came back with node -1
  json document = validDocument();
  document["accessors"].push_back(
      json::parse(R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "SCALAR"})"));
  document["animations"] = json::parse(R"([{"channels":[{"sampler":0,"targut":{"node":0,"path":"scale"}}],
                                           "samplers":[{"input":1,"output":0}]}])");
  EXPECT_EQ(load(glb(document.dump(), kTriangle)), ErrorCode::kMalformed);
}

TEST(GltfHostile, APrimitiveWithoutAttributes) {  // found by the glTF fuzzer: tinygltf does not write an empty object
  EXPECT_EQ(loadPatched("/meshes/0/primitives/0/attributes", json::object()), ErrorCode::kMalformed);
}

TEST(GltfHostile, MeshesWithoutPositionsAreNotQuantised) {  // found by the bake fuzzer
  json document = validDocument();
  document["meshes"][0]["primitives"][0]["attributes"] = {{"NORMAL", 0}};
  const TempFolder folder;
  tinygltf::Model model = loadGltf(folder.write("a.glb", glb(document.dump(), kTriangle)));
  quantizeModel(model);
  EXPECT_TRUE(model.extensionsUsed.empty());
}

TEST(GltfHostile, AnOffsetIntoNoView) {  // found by the glTF fuzzer: it came back negative
  json document = validDocument();
  document["accessors"][0] =
      json::parse(R"({"componentType": 5126, "count": 3, "type": "VEC3", "byteOffset": 4294967292})");
  EXPECT_EQ(load(glb(document.dump(), kTriangle)), ErrorCode::kMalformed);
}

TEST(GltfHostile, CamerasWithoutALens) {  // found by the GLB fuzzer: tinygltf does not write a yfov of 0
  for (const char* camera :
       {R"({"type": "perspective", "perspective": {"yfov": 0, "znear": 0.1}})",
        R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0}})",
        R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 1, "zfar": 0.5}})",
        R"({"type": "orthographic", "orthographic": {"xmag": 0, "ymag": 1, "znear": 0, "zfar": 1}})"})
    EXPECT_EQ(loadPatched("/cameras/0", json::parse(camera)), ErrorCode::kMalformed) << camera;
}

TEST(GltfHostile, RangesOutsideTheirContainer) {
  for (const json& value : {json(37), json(1ULL << 33U), json(-1), json(18446744073709551615ULL)}) {
    EXPECT_EQ(loadPatched("/bufferViews/0/byteLength", value), ErrorCode::kMalformed) << value;
    EXPECT_EQ(loadPatched("/bufferViews/0/byteOffset", value), ErrorCode::kMalformed) << value;
    EXPECT_EQ(loadPatched("/accessors/0/byteOffset", value), ErrorCode::kMalformed) << value;
    EXPECT_EQ(loadPatched("/buffers/0/byteLength", value), ErrorCode::kMalformed) << value;
  }
  EXPECT_EQ(loadPatched("/accessors/0/count", 4), ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/accessors/0/count", 0), ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/accessors/0/componentType", 5130), ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/bufferViews/0/byteStride", 16), ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/bufferViews/0/byteStride", 8), ErrorCode::kMalformed);
}

/// No accessor uses the second view, so that no other check can refuse it.
TEST(GltfHostile, AViewWithAnOffsetEndsInItsBuffer) {
  json document = validDocument();
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 4}, {"byteLength", 32}});
  EXPECT_EQ(load(glb(document.dump(), kTriangle)), std::nullopt);
  document["bufferViews"][1]["byteLength"] = 33;
  EXPECT_EQ(reasonOf(document), "hostile.glb: buffer view 1 reaches outside its buffer of 36 bytes");
  EXPECT_EQ(load(glb(document.dump(), kTriangle)), ErrorCode::kMalformed);
}

TEST(GltfHostile, HugeCountWithoutAViewHitsTheLimit) {
  json document = validDocument();
  document["accessors"][0].erase("bufferView");
  document["accessors"][0]["count"] = 4294967295U;
  EXPECT_EQ(load(glb(document.dump(), kTriangle)), ErrorCode::kLimit);
}

TEST(GltfHostile, ManyPrimitivesOnOneAccessorHitTheLimit) {
  json document = validDocument();
  const json primitive = document["meshes"][0]["primitives"][0];
  for (int i = 0; i < 99; ++i)
    document["meshes"][0]["primitives"].push_back(primitive);
  Limits limits;
  limits.maxAccessorElements = 200;
  EXPECT_EQ(load(glb(document.dump(), kTriangle), limits), ErrorCode::kLimit);
}

TEST(GltfHostile, ViewsAndSparseBlocksCannotReadTheSameBytesForEver) {
  const std::string chunk(1U << 20U, '\0');
  json document = validDocument();
  document["buffers"][0]["byteLength"] = chunk.size();
  const json view = {{"buffer", 0}, {"byteLength", chunk.size()}};
  for (std::size_t i = 1; i < 60; ++i)
    document["bufferViews"][i] = view;
  EXPECT_EQ(load(glb(document.dump(), chunk)), std::nullopt) << "an honest amount";
  json views = document;
  for (std::size_t i = 60; i < 100; ++i)
    views["bufferViews"][i] = view;
  EXPECT_EQ(load(glb(views.dump(), chunk)), ErrorCode::kLimit);
  for (std::size_t i = 1; i < 2000; ++i) {
    document["accessors"][i] = {{"componentType", 5126},
                                {"count", 4000},
                                {"type", "SCALAR"},
                                {"sparse",
                                 {{"count", 4000},
                                  {"indices", {{"bufferView", 1}, {"componentType", 5125}}},
                                  {"values", {{"bufferView", 2}}}}}};
  }
  EXPECT_EQ(load(glb(document.dump(), chunk)), ErrorCode::kMalformed) << "indices that do not ascend";
  for (std::size_t i = 2000; i < 4000; ++i)
    document["accessors"][i] = document["accessors"][1];
  EXPECT_EQ(load(glb(document.dump(), chunk)), ErrorCode::kLimit);
}

TEST(GltfHostile, NodesMustFormAForest) {
  EXPECT_EQ(loadPatched("/nodes/1/children", {0}), ErrorCode::kMalformed) << "cycle through the root";
  EXPECT_EQ(loadPatched("/nodes/1/children", {1}), ErrorCode::kMalformed) << "own child";
  EXPECT_EQ(loadPatched("/nodes/0/children", {1, 1}), ErrorCode::kMalformed) << "child twice";
  EXPECT_EQ(loadPatched("/scenes/0/nodes", {0, 0}), ErrorCode::kMalformed) << "root twice";
}

TEST(GltfHostile, CycleThatNoSceneReaches) {
  json document = validDocument();
  document["nodes"].push_back({{"children", {3}}});
  document["nodes"].push_back({{"children", {2}}});
  EXPECT_EQ(load(glb(document.dump(), kTriangle)), ErrorCode::kMalformed);
}

TEST(GltfHostile, LongChainOfNodesLoads) {
  json document = validDocument();
  for (int i = 1; i < 100'000; ++i) {
    document["nodes"][static_cast<std::size_t>(i)] = {{"children", {i + 1}}};
  }
  document["nodes"].push_back(json::object());
  EXPECT_EQ(load(glb(document.dump(), kTriangle)), std::nullopt);
}

TEST(GltfHostile, InstanceCapCountsAllNodes) {
  json document = validDocument();
  document["nodes"][1] = {{"mesh", 0},
                          {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", 0}}}}}}}};
  Limits limits;
  limits.maxInstances = 4;
  EXPECT_EQ(load(glb(document.dump(), kTriangle), limits), std::nullopt);
  limits.maxInstances = 3;
  EXPECT_EQ(load(glb(document.dump(), kTriangle), limits), ErrorCode::kLimit);
}

/// The document itself is refused: scenes are counted again when they are read, but not every program reads one.
TEST(GltfHostile, InstanceCapCountsAllNodesOfADocument) {
  json document = validDocument();
  const json instances = {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", 0}}}}}};
  document["nodes"][0]["extensions"] = instances;
  document["nodes"][1] = {{"mesh", 0}, {"extensions", instances}};
  Limits limits;
  limits.maxInstances = 6;
  EXPECT_EQ(reasonOf(document, limits), "");
  limits.maxInstances = 5;
  EXPECT_EQ(reasonOf(document, limits), "hostile.glb: more than 5 instances");
}

TEST(GltfHostile, PositionsThatAreNotFinite) {
  std::string nan = kTriangle;
  const float value = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + 8, &value, 4);
  EXPECT_EQ(load(glb(validDocument().dump(), nan)), ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/nodes/0/translation", {1e39, 0, 0}), ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/nodes/0/rotation", {0, 0, 0, 0}), ErrorCode::kMalformed);
}

/// A folder with a document that names `uri` as its buffer; `secret.bin` lies one folder above.
std::optional<ErrorCode> loadUri(const TempFolder& outer, const std::string& uri) {
  std::filesystem::create_directory(outer / "inner");
  outer.write("secret.bin", kTriangle);
  json document = validDocument();
  document["buffers"][0]["uri"] = uri;
  const std::filesystem::path file = outer.write("inner/m.gltf", document.dump());
  return codeOf([&] { loadGltf(file); });
}

TEST(GltfHostile, UriThatLeavesTheFolder) {
  const TempFolder outer;
  for (const char* uri :
       {"../secret.bin", "%2e%2e/secret.bin", "..%2Fsecret.bin", "a/../../secret.bin", "./.././inner/../secret.bin",
        "/etc/hostname", "file:///etc/hostname", "https://example.org/x.bin", "c:/x.bin"})
    EXPECT_EQ(loadUri(outer, uri), ErrorCode::kUnsupported) << uri;
}

TEST(GltfHostile, SymbolicLinkThatLeavesTheFolder) {
  const TempFolder outer;
  std::filesystem::create_directory(outer / "inner");
  std::filesystem::create_symlink("../secret.bin", outer / "inner/link.bin");
  std::filesystem::create_directory_symlink("..", outer / "inner/up");
  EXPECT_EQ(loadUri(outer, "link.bin"), ErrorCode::kUnsupported);
  EXPECT_EQ(loadUri(outer, "up/secret.bin"), ErrorCode::kUnsupported);
}

TEST(GltfHostile, SymbolicLinkInsideTheFolderIsFine) {
  const TempFolder outer;
  std::filesystem::create_directory(outer / "inner");
  outer.write("inner/real.bin", kTriangle);
  std::filesystem::create_symlink("real.bin", outer / "inner/link.bin");
  EXPECT_EQ(loadUri(outer, "link.bin"), std::nullopt);
}

TEST(GltfHostile, UriOfAFolderOrDeviceOrNothing) {
  const TempFolder outer;
  EXPECT_EQ(loadUri(outer, "."), ErrorCode::kFileUnreadable);
  EXPECT_EQ(loadUri(outer, "absent.bin"), ErrorCode::kFileNotFound);
  EXPECT_EQ(loadUri(outer, ""), ErrorCode::kMalformed);
  EXPECT_EQ(loadUri(outer, "a%00b"), ErrorCode::kMalformed);
  ASSERT_EQ(::mkfifo((outer / "inner/pipe").c_str(), 0600), 0);
  EXPECT_EQ(loadUri(outer, "pipe"), ErrorCode::kFileUnreadable);
}

TEST(GltfHostile, DataUrisThatAreBroken) {
  const TempFolder outer;
  for (const char* uri : {"data:", "data:,abc", "data:;base64", "data:;base64,????", "data:;base64,A",
                          "data:application/octet-stream;base64,AAAA"})
    EXPECT_EQ(loadUri(outer, uri), ErrorCode::kMalformed) << uri;
}

TEST(GltfHostile, ExternalBytesAreCountedTogether) {
  const TempFolder folder;
  folder.write("a.bin", std::string(1000, 'a'));
  json document = validDocument();
  for (int i = 0; i < 3; ++i)
    document["buffers"][static_cast<std::size_t>(i)] = {{"byteLength", 1000}, {"uri", "a.bin"}};
  const std::filesystem::path file = folder.write("m.gltf", document.dump());
  Limits limits;
  limits.maxFileBytes = 3000;
  EXPECT_EQ(codeOf([&] { loadGltf(file, limits); }), std::nullopt);
  limits.maxFileBytes = 2999;
  EXPECT_EQ(codeOf([&] { loadGltf(file, limits); }), ErrorCode::kLimit);
}

TEST(GltfHostile, BrokenImagesAndChains) {
  EXPECT_EQ(loadPatched("/images", json::parse(R"([{"bufferView": 4, "mimeType": "image/png"}])")),
            ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/images", json::parse(R"([{}])")), ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/images", json::parse(R"([{"bufferView": 0, "uri": "x.png"}])")), ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/nodes/0/extensions", json::parse(R"({"MSFT_lod": {"ids": [7]}})")), ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/nodes/0/extensions", json::parse(R"({"MSFT_lod": {"ids": [4294967297]}})")),
            ErrorCode::kMalformed);
  EXPECT_EQ(loadPatched("/nodes/0/extensions", json::parse(R"({"MSFT_lod": 3})")), ErrorCode::kMalformed);
  EXPECT_EQ(
      loadPatched("/nodes/0/extensions", json::parse(R"({"EXT_mesh_gpu_instancing": {"attributes": {"SCALE": 12}}})")),
      ErrorCode::kMalformed);
}

TEST(GltfHostile, RandomDamageNeverCrashes) {
  const std::string good = glb(validDocument().dump(), kTriangle);
  std::uint32_t state = 1;
  const auto next = [&] { return state = state * 1664525U + 1013904223U; };
  for (int round = 0; round < 500; ++round) {
    std::string bytes = good;
    for (int change = 0; change < 3; ++change)
      bytes[(next() >> 8U) % bytes.size()] = static_cast<char>(next() >> 24U);
    load(bytes);  // any Error will do; other exceptions and signals fail the test
  }
}

TEST(GltfHostile, MissingFile) {
  EXPECT_EQ(codeOf([] { loadGltf("/nonexistent/file.glb"); }), ErrorCode::kFileNotFound);
  EXPECT_EQ(codeOf([] { loadGltf("/"); }), ErrorCode::kFileUnreadable);
}

}  // namespace
}  // namespace jalousie::asset
