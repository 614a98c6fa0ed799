// Saving and loading: what a round trip keeps, what encoding drops, where external data may come from.
#include "asset/gltf_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "asset/asset_fixtures.h"
#include "asset/image_io.h"

namespace jalousie::asset {
namespace {

using test::addNode;
using test::addTriangle;
using test::TempFolder;

std::vector<unsigned char> smallPng() {
  const ImageRgba8 image{2, 2, std::vector<std::uint8_t>(16, 200)};
  const std::vector<std::byte> png = encodePng(image);
  const auto* first = reinterpret_cast<const unsigned char*>(png.data());
  return {first, first + png.size()};
}

tinygltf::Model texturedModel() {
  tinygltf::Model model;
  tinygltf::Image image;
  image.name = "squares";
  image.as_is = true;
  image.image = smallPng();
  model.images.push_back(image);
  tinygltf::Texture texture;
  texture.source = 0;
  model.textures.push_back(texture);
  tinygltf::Material material;
  material.name = "leaf";
  material.alphaMode = "MASK";
  material.alphaCutoff = 0.25;
  material.doubleSided = true;
  material.pbrMetallicRoughness.baseColorFactor = {0.5, 0.25, 0.125, 1.0};
  material.pbrMetallicRoughness.baseColorTexture.index = 0;
  model.materials.push_back(material);
  const int mesh = addTriangle(model);
  model.meshes[0].primitives[0].material = 0;
  addNode(model, mesh, "root");
  model.nodes[0].translation = {1.0, 2.0, 3.0};
  test::setScene(model, {0});
  return model;
}

nlohmann::json jsonOf(const std::vector<std::byte>& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const auto* text = reinterpret_cast<const char*>(glb.data() + 20);
  return nlohmann::json::parse(std::string(text, length));
}

TEST(GltfFile, RoundTripKeepsModelAndImage) {
  const TempFolder folder;
  saveGlb(texturedModel(), folder / "model.glb");
  const tinygltf::Model model = loadGltf(folder / "model.glb");
  ASSERT_EQ(model.images.size(), 1U);
  EXPECT_EQ(model.images[0].image, smallPng());
  EXPECT_EQ(model.images[0].mimeType, "image/png");
  EXPECT_TRUE(model.images[0].as_is);
  EXPECT_EQ(model.materials[0].alphaMode, "MASK");
  EXPECT_DOUBLE_EQ(model.materials[0].alphaCutoff, 0.25);
  EXPECT_TRUE(model.materials[0].doubleSided);
  EXPECT_EQ(model.nodes[0].translation, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(readVec3(model, model.meshes[0].primitives[0].attributes.at("POSITION"), 10).size(), 3U);
}

TEST(GltfFile, EncodingIsDeterministicAndStable) {
  const TempFolder folder;
  const std::vector<std::byte> first = encodeGlb(texturedModel());
  EXPECT_EQ(first, encodeGlb(texturedModel()));
  saveGlb(texturedModel(), folder / "model.glb");
  EXPECT_EQ(encodeGlb(loadGltf(folder / "model.glb")), first);
}

TEST(GltfFile, UnreferencedDataIsDropped) {
  tinygltf::Model model = texturedModel();
  const std::vector<std::byte> lean = encodeGlb(model);
  appendVec3(model, std::vector<glm::vec3>(1000, glm::vec3(1.0F)), 0);
  EXPECT_EQ(encodeGlb(model), lean);
}

TEST(GltfFile, SeveralBuffersBecomeOne) {
  tinygltf::Model model = texturedModel();
  const std::vector<std::byte> single = encodeGlb(model);
  // Move the positions to a second buffer, with bytes before them that nothing uses.
  const int accessor = model.meshes[0].primitives[0].attributes.at("POSITION");
  tinygltf::BufferView& view =
      model.bufferViews[static_cast<std::size_t>(model.accessors[static_cast<std::size_t>(accessor)].bufferView)];
  tinygltf::Buffer second;
  second.data.assign(20, 0xAB);
  const auto first = model.buffers[0].data.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
  second.data.insert(second.data.end(), first, first + static_cast<std::ptrdiff_t>(view.byteLength));
  view.buffer = 1;
  view.byteOffset = 20;
  model.buffers.push_back(second);
  EXPECT_EQ(encodeGlb(model), single);
}

TEST(GltfFile, InfiniteProjectionAndEmptyNodesStayValidJson) {
  tinygltf::Model model = texturedModel();
  tinygltf::Camera camera;
  camera.type = "perspective";
  camera.perspective.yfov = 1.0;
  camera.perspective.znear = 0.1;
  model.cameras.push_back(camera);
  model.nodes.emplace_back();
  model.animations.emplace_back();
  const nlohmann::json document = jsonOf(encodeGlb(model));
  EXPECT_FALSE(document["cameras"][0]["perspective"].contains("zfar"));
  EXPECT_TRUE(document["nodes"][1].is_object());
  EXPECT_FALSE(document.contains("animations"));
  EXPECT_EQ(document["buffers"].size(), 1U);
}

TEST(GltfFile, ViewsAndChunksAreAligned) {
  const std::vector<std::byte> glb = encodeGlb(texturedModel());
  EXPECT_EQ(glb.size() % 4, 0U);
  const nlohmann::json document = jsonOf(glb);
  for (const auto& view : document["bufferViews"])
    EXPECT_EQ(view.value("byteOffset", 0) % 4, 0);
}

TEST(GltfFile, ImageThatIsNoPngOrJpegIsNotWritten) {
  tinygltf::Model model = texturedModel();
  model.images[0].image = {'G', 'I', 'F', '8'};
  EXPECT_EQ(test::codeOf([&] { encodeGlb(model); }), ErrorCode::kUnsupported);
}

TEST(GltfFile, FailedSaveLeavesNothing) {
  const TempFolder folder;
  EXPECT_EQ(test::codeOf([&] { saveGlb(texturedModel(), folder / "absent/model.glb"); }), ErrorCode::kWriteFailed);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

constexpr const char* kExternal = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"%URI%"}],)"
                                  R"("bufferViews":[{"buffer":0,"byteLength":4}]})";

std::string external(const std::string& uri) {
  std::string text = kExternal;
  return text.replace(text.find("%URI%"), 5, uri);
}

TEST(GltfFile, ExternalBufferIsReadFromTheFolder) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "data");
  folder.write("data/a b.bin", "wxyz and more");
  const tinygltf::Model model = loadGltf(folder.write("m.gltf", external("data/a%20b.bin")));
  EXPECT_EQ(std::string(model.buffers[0].data.begin(), model.buffers[0].data.end()), "wxyz");
  EXPECT_TRUE(model.buffers[0].uri.empty());
}

TEST(GltfFile, PathThatStaysInsideMayUseDots) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "data");
  folder.write("x.bin", "wxyz");
  EXPECT_NO_THROW(loadGltf(folder.write("m.gltf", external("data/../x.bin"))));
}

TEST(GltfFile, DataUriIsDecoded) {
  const TempFolder folder;
  for (const char* uri : {"data:application/octet-stream;base64,d3h5eg==", "data:;base64,d3h5eg",
                          "data:application/gltf-buffer;base64,d3h5enp6"}) {
    const tinygltf::Model model = loadGltf(folder.write("m.gltf", external(uri)));
    EXPECT_EQ(std::string(model.buffers[0].data.begin(), model.buffers[0].data.end()), "wxyz") << uri;
  }
}

TEST(GltfFile, RelativePathWithoutFolderLoads) {
  const TempFolder folder;
  folder.write("x.bin", "wxyz");
  folder.write("m.gltf", external("x.bin"));
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_NO_THROW(loadGltf("m.gltf"));
  std::filesystem::current_path(before);
}

TEST(GltfFile, NamesOfSamplersSurvive) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.samplers.resize(2);
  model.samplers[1].name = "nearest";
  const test::TempFolder folder;
  saveGlb(model, folder / "file.glb");
  const tinygltf::Model read = loadGltf(folder / "file.glb");
  ASSERT_EQ(read.samplers.size(), 2U);
  EXPECT_EQ(read.samplers[0].name, "");
  EXPECT_EQ(read.samplers[1].name, "nearest");
}

}  // namespace
}  // namespace jalousie::asset
