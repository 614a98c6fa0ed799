// Numbers that a document must not hold: each is refused with its reason, and so are the limits of ranges.
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "asset/accessor_layout.h"
#include "asset/asset_fixtures.h"
#include "asset/gltf_quantize.h"
#include "support/rich_gltf.h"

namespace jalousie::asset {
namespace {

using nlohmann::json;
using test::RichGltf;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What parseGltf says about a document; empty if it accepts it.
std::string reasonOf(const std::string& bytes) {
  try {
    parseGltf(std::as_bytes(std::span(bytes.data(), bytes.size())), "rich.glb");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMalformed) << error.what();
    return error.what();
  }
  return "";
}

struct Case {
  const char* reason;  ///< part of the message
  std::function<void(RichGltf&)> damage;
};

void expectReasons(const std::vector<Case>& cases) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    RichGltf rich;
    cases[i].damage(rich);
    const std::string reason = reasonOf(rich.glb());
    EXPECT_NE(reason.find(cases[i].reason), std::string::npos)
        << "case " << i << ": '" << reason << "' does not say '" << cases[i].reason << "'";
  }
}

/// Sets one member by its JSON pointer.
Case set(const char* reason, const char* pointer, const json& value) {
  return {reason, [=](RichGltf& rich) { rich.document[json::json_pointer(pointer)] = value; }};
}

/// Sets component `component` of an accessor of floats.
Case put(const char* reason, int RichGltf::*accessor, std::size_t component, float value) {
  return {reason, [=](RichGltf& rich) { rich.setFloat(rich.*accessor, component, value); }};
}

TEST(GltfValues, TheUndamagedDocumentLoads) {
  EXPECT_EQ(reasonOf(RichGltf().glb()), "");
}

TEST(GltfValues, MatricesAreAffine) {
  expectReasons({set("node 0: the last row of the matrix is not 0 0 0 1", "/nodes/0",
                     {{"matrix", {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}})});
}

/// Four million matrices that no byte stands for: their check must not expand them.
TEST(GltfValues, ZerosOfAnAccessorAreNotExpandedToBeChecked) {
  RichGltf rich;
  json& accessor = rich.document["accessors"][static_cast<std::size_t>(rich.matrices)];
  accessor = {{"componentType", 5126}, {"count", 4'000'000}, {"type", "MAT4"}};
  const tinygltf::Model model = [&] {
    const std::string bytes = rich.glb();
    return parseGltf(std::as_bytes(std::span(bytes.data(), bytes.size())), "rich.glb");
  }();
  std::size_t visited = 0;
  visitComponents(model, rich.matrices, [&](float) { ++visited; });
  EXPECT_EQ(visited, 0U);
}

TEST(GltfValues, ComponentsAreThoseOfTheFileAndOfItsSparseValues) {
  tinygltf::Model model;
  const std::vector<glm::vec3> vectors = {{1, 2, 3}, {4, 5, 6}};
  const int accessor = appendVec3(model, vectors, 0);
  const int values = appendVec3(model, std::vector<glm::vec3>{{7, 8, kNan}}, 0);
  std::vector<float> seen;
  visitComponents(model, accessor, [&](float value) { seen.push_back(value); });
  EXPECT_EQ(seen, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(holdsFiniteNumbers(model, accessor));
  EXPECT_FALSE(holdsFiniteNumbers(model, values));
  tinygltf::Accessor& sparse = model.accessors[static_cast<std::size_t>(accessor)];
  sparse.sparse.isSparse = true;
  sparse.sparse.count = 1;
  sparse.sparse.indices = {.byteOffset = 0,
                           .bufferView = model.accessors[static_cast<std::size_t>(values)].bufferView,
                           .componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE};
  sparse.sparse.values.bufferView = model.accessors[static_cast<std::size_t>(values)].bufferView;
  sparse.sparse.values.byteOffset = 0;
  EXPECT_FALSE(holdsFiniteNumbers(model, accessor));
}

TEST(GltfValues, JointsAndWeights) {
  expectReasons({
      {"joint 2 of JOINTS_0 is out of range, the skin has 2",
       [](RichGltf& rich) { rich.binary[rich.offsetOf(rich.joints) + 5] = 2; }},
      put("negative or not finite", &RichGltf::weights, 3, -0.5F),
      put("negative or not finite", &RichGltf::weights, 0, kNan),
      put("negative or not finite", &RichGltf::weights, 0, kInfinity),
      put("skin 0: accessor", &RichGltf::matrices, 31, kNan),
      set("does not hold a matrix for each of 3 joints", "/skins/0/joints", {2, 3, 0}),
      set("skeleton 99 is out of range", "/skins/0/skeleton", 99),
  });
}

TEST(GltfValues, MorphTargets) {
  expectReasons({
      set("mesh 2: 1 weights for 2 morph targets", "/meshes/2/weights", {0.5}),
      set("mesh 0: 1 weights for 0 morph targets", "/meshes/0/weights", {0.5}),
      set("node 5: 3 weights for 2 morph targets", "/nodes/5/weights", {0.5, 0, 0}),
      set("node 10 has weights of morph targets and no mesh", "/nodes/10/weights", {0.5}),
      set("not finite", "/meshes/2/weights/0", 1e300),
      {"its primitives have 2 and 0 morph targets",
       [](RichGltf& rich) {
         rich.document["meshes"][2]["primitives"].push_back(rich.document["meshes"][3]["primitives"][0]);
       }},
  });
}

TEST(GltfValues, Cameras) {
  expectReasons({
      set("camera 0: yfov 3.2", "/cameras/0/perspective/yfov", 3.2),
      set("camera 0: yfov 3.14159", "/cameras/0/perspective/yfov", 3.14159265),  // as a float it is more than pi
      set("camera 0: yfov -1", "/cameras/0/perspective/yfov", -1),
      set("camera 0: yfov 1e-50", "/cameras/0/perspective/yfov", 1e-50),
      set("camera 0: znear 1e-50", "/cameras/0/perspective/znear", 1e-50),
      set("camera 0: znear 1e+300", "/cameras/0/perspective/znear", 1e300),
      set("camera 0: zfar 0.1", "/cameras/0/perspective/zfar", 0.1),
      set("camera 0: zfar 1e+300", "/cameras/0/perspective/zfar", 1e300),
      set("camera 0: aspectRatio -1", "/cameras/0/perspective/aspectRatio", -1),
      set("camera 0: aspectRatio 1e+300", "/cameras/0/perspective/aspectRatio", 1e300),
      set("camera 1: xmag 0", "/cameras/1/orthographic/xmag", 0),
      set("camera 1: ymag 1e+300", "/cameras/1/orthographic/ymag", 1e300),
      set("camera 1: znear -1", "/cameras/1/orthographic/znear", -1),
      set("camera 1: zfar 0.5", "/cameras/1/orthographic/zfar", 0.5),
  });
}

TEST(GltfValues, Animations) {
  expectReasons({
      put("times must be finite and ascend, key 1", &RichGltf::times, 1, kNan),
      put("times must be finite and ascend, key 2", &RichGltf::times, 2, 1.0F),
      put("times must be finite and ascend, key 2", &RichGltf::times, 2, kInfinity),
      put("holds a number that is not finite", &RichGltf::offsets, 4, kInfinity),
      put("holds a number that is not finite", &RichGltf::morphWeights, 5, kNan),
      put("holds a number that is not finite", &RichGltf::splineRotations, 0, kNan),
      put("rotation 0 has no direction", &RichGltf::rotations, 3, 0.0F),
      put("rotation 4 has no direction", &RichGltf::splineRotations, 17, 0.0F),
      set("interpolation \"CUBIC\" is not known", "/animations/0/samplers/0/interpolation", "CUBIC"),
      set("3 values for 3 times", "/animations/0/samplers/0/interpolation", "CUBICSPLINE"),
      set("9 values for 3 times", "/animations/0/samplers/2/interpolation", "LINEAR"),
      set("path \"size\" is not known", "/animations/0/channels/0/target/path", "size"),
      set("path \"pointer\" is not known", "/animations/0/channels/0/target/path", "pointer"),
      set("values have the wrong type for rotation", "/animations/0/channels/0/target/path", "rotation"),
      set("weights of node 10, which has no morph targets", "/animations/0/channels/3/target/node", 10),
      {"4 values for 3 times",
       [](RichGltf& rich) { rich.document["accessors"][static_cast<std::size_t>(rich.morphWeights)]["count"] = 4; }},
  });
}

TEST(GltfValues, TransformsAlongTheHierarchy) {
  expectReasons({
      set("node 0: a node's rotation has no direction", "/nodes/0/rotation", {0, 0, 0, 0}),
      set("node 1: transform is not finite", "/nodes/1/scale", {1e300, 1, 1}),
      set("node 6: transform is not finite", "/nodes/6/matrix/0", 1e300),
      {"node 3: transform is not finite",
       [](RichGltf& rich) {
         rich.document["nodes"][2]["scale"] = {1e30, 1e30, 1e30};
         rich.document["nodes"][3]["scale"] = {1e30, 1e30, 1e30};
       }},
      {"node 14: transform is not finite",
       [](RichGltf& rich) {
         rich.document["nodes"].push_back({{"translation", {1e39, 0, 0}}});
       }},
      put("accessor", &RichGltf::instanceRotations, 3, 0.0F),
      put("node 13: an instance's translation or scale is not finite", &RichGltf::instanceOffsets, 1, kNan),
  });
}

TEST(GltfValues, AccessorBounds) {
  expectReasons({
      set("accessor 0: min has 2 numbers, its elements have 3", "/accessors/0/min", {0, 0}),
      set("accessor 0: max is not finite", "/accessors/0/max/1", 1e300),
  });
}

TEST(GltfValues, BakedExtras) {
  expectReasons({
      set("mesh 5: extras.jalousie is not an object", "/meshes/5/extras/jalousie", 7),
      set("mesh 6: extras.jalousie.errorObject is negative", "/meshes/6/extras/jalousie/errorObject", -1),
      set("mesh 6: extras.jalousie.errorObject is no finite float", "/meshes/6/extras/jalousie/errorObject", 1e300),
      set("mesh 6: extras.jalousie.format is 9", "/meshes/6/extras/jalousie/format", 9),
      set("mesh 0: extras.jalousie.format is not a number", "/meshes/0/extras", {{"jalousie", {{"lod", 0}}}}),
  });
}

TEST(GltfValues, IndicesOfKnownExtensions) {
  expectReasons({
      set("MSFT_lod: index 1 is out of range, there are 1", "/materials/0/extensions", {{"MSFT_lod", {{"ids", {1}}}}}),
      set("EXT_texture_webp: index 3 is out of range", "/textures/0/extensions",
          {{"EXT_texture_webp", {{"source", 3}}}}),
      set("KHR_lights_punctual: index 0 is out of range", "/nodes/3/extensions",
          {{"KHR_lights_punctual", {{"light", 0}}}}),
      set("KHR_materials_variants: index 4 is out of range", "/meshes/0/primitives/0/extensions",
          {{"KHR_materials_variants", {{"mappings", {{{"material", 4}, {"variants", json::array()}}}}}}}),
      set("KHR_materials_variants: index 0 is out of range", "/meshes/0/primitives/0/extensions",
          {{"KHR_materials_variants", {{"mappings", {{{"material", 0}, {"variants", {0}}}}}}}}),
  });
}

TEST(GltfValues, IndicesOfEveryModeAreBelowTheVertexCount) {
  // Four vertices: 4 is the first index out of range, for points in a row as for triangles.
  for (const int mode : {0, 1, 2, 3, 4, 5, 6}) {
    RichGltf rich;
    json& primitive = rich.document["meshes"][4]["primitives"][0];
    primitive["mode"] = mode;
    EXPECT_EQ(reasonOf(rich.glb()), "") << mode;
    rich.binary[rich.offsetOf(primitive["indices"].get<int>()) + 6] = 4;
    EXPECT_NE(reasonOf(rich.glb()).find("vertex index 4 is out of range, there are 4 vertices"), std::string::npos)
        << mode;
  }
}

TEST(GltfValues, TangentsAreVec4OutsideOfMorphTargets) {
  RichGltf rich;
  json& attributes = rich.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["TANGENT"] = attributes["NORMAL"];
  EXPECT_NE(reasonOf(rich.glb()).find("wrong type for TANGENT"), std::string::npos);
}

TEST(GltfValues, DracoDataBesideUncompressedDataIsLeftOut) {
  RichGltf rich;
  rich.document["extensionsUsed"].push_back("KHR_draco_mesh_compression");
  rich.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
  const std::string bytes = rich.glb();
  const tinygltf::Model model = parseGltf(std::as_bytes(std::span(bytes.data(), bytes.size())), "rich.glb");
  EXPECT_TRUE(model.meshes[0].primitives[0].extensions.empty());
  EXPECT_EQ(model.extensionsUsed, (std::vector<std::string>{"MSFT_lod", "EXT_mesh_gpu_instancing"}));
}

TEST(GltfValues, AnElementMustEndWithinItsView) {
  using detail::fits;
  EXPECT_TRUE(fits(12, 0, 12, 12, 1));
  EXPECT_FALSE(fits(11, 0, 12, 12, 1)) << "the only element ends behind the view";
  EXPECT_FALSE(fits(12, 8, 12, 12, 1)) << "it begins within the view and ends behind it";
  EXPECT_FALSE(fits(12, 13, 12, 12, 1)) << "it begins behind the view";
  EXPECT_TRUE(fits(28, 0, 16, 12, 2)) << "the last element needs no padding";
  EXPECT_FALSE(fits(27, 0, 16, 12, 2));
  EXPECT_FALSE(fits(24, 0, 12, 12, 3)) << "the last element is missing";
  EXPECT_FALSE(fits(24, 4, 0, 24, 1));
}

TEST(GltfValues, PositionsThatSpanMoreThanAFloatAreNotQuantised) {
  tinygltf::Model model;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] =
      appendVec3(model, std::vector<glm::vec3>{{-3e38F, 0, 0}, {3e38F, 0, 0}, {0, 1, 0}}, 0);
  tinygltf::Mesh mesh;
  mesh.primitives = {primitive};
  model.meshes = {mesh};
  tinygltf::Node node;
  node.mesh = 0;
  model.nodes = {node};
  try {
    quantizeModel(model);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUnsupported);
    EXPECT_NE(std::string(error.what()).find("leave out --quantize"), std::string::npos) << error.what();
  }
}

/// The JSON and the binary chunk of a GLB file.
std::pair<json, std::string> chunksOf(const std::vector<std::byte>& file) {
  const std::string bytes(reinterpret_cast<const char*>(file.data()), file.size());
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof length);
  return {json::parse(bytes.substr(20, length)), bytes.substr(28 + length)};
}

TEST(GltfValues, ACompressedStreamMustEndWithinItsBuffer) {
  const std::string plain = RichGltf().glb();
  tinygltf::Model model = parseGltf(std::as_bytes(std::span(plain.data(), plain.size())), "rich.glb");
  auto [document, binary] = chunksOf(encodeGlb(std::move(model), {true}));
  json* last = nullptr;  // the stream that ends last
  for (json& view : document["bufferViews"]) {
    if (!view.contains("extensions")) continue;
    json& stream = view["extensions"]["EXT_meshopt_compression"];
    if (last == nullptr || stream["byteOffset"] > (*last)["byteOffset"]) last = &stream;
  }
  ASSERT_NE(last, nullptr);
  const std::size_t left =
      document["buffers"][0]["byteLength"].get<std::size_t>() - (*last)["byteOffset"].get<std::size_t>();
  EXPECT_EQ(reasonOf(test::glb(document.dump(), binary)), "");
  (*last)["byteLength"] = left + 1;
  EXPECT_NE(reasonOf(test::glb(document.dump(), binary)).find("data lies outside its buffer"), std::string::npos);
  (*last)["byteLength"] = left + 100'000;
  EXPECT_NE(reasonOf(test::glb(document.dump(), binary)).find("data lies outside its buffer"), std::string::npos);
}

TEST(GltfValues, TrianglesSharedWithAStripKeepTheirOrderWhenCompressed) {
  RichGltf rich;
  // Mesh 4 draws as a strip what mesh 1 draws as triangles.
  rich.document["meshes"][4]["primitives"][0]["indices"] = rich.document["meshes"][1]["primitives"][0]["indices"];
  const std::string plain = rich.glb();
  tinygltf::Model model = parseGltf(std::as_bytes(std::span(plain.data(), plain.size())), "rich.glb");
  const int strip = model.meshes[4].primitives[0].indices;
  const std::vector<std::uint32_t> before = readIndices(model, strip, 4, 100);
  const tinygltf::Model after = parseGltf(encodeGlb(std::move(model), {true}), "rich.glb");
  EXPECT_EQ(readIndices(after, after.meshes[4].primitives[0].indices, 4, 100), before);
}

}  // namespace
}  // namespace jalousie::asset
