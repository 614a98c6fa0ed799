// Pictures of documents: EXT_texture_webp, names in messages, the check of everything that is passed on.
#include "asset/gltf_images.h"

#include "asset/asset_fixtures.h"
#include "asset/scene_file.h"
#include "support/picture_writer.h"

namespace jalousie::asset {
namespace {

using namespace jalousie::test;

int addImage(tinygltf::Model& model, const std::string& bytes) {
  tinygltf::Image image;
  image.image.assign(bytes.begin(), bytes.end());
  model.images.push_back(std::move(image));
  return static_cast<int>(model.images.size()) - 1;
}

/// A triangle with the base colour texture 0, whose source is image 0.
tinygltf::Model texturedTriangle(const std::string& picture) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  setScene(model, {addNode(model, addTriangle(model))});
  model.textures.resize(1);
  model.textures[0].source = addImage(model, picture);
  model.materials.resize(1);
  model.materials[0].pbrMetallicRoughness.baseColorTexture.index = 0;
  model.meshes[0].primitives[0].material = 0;
  return model;
}

tinygltf::Value webpExtension(int source) {
  return tinygltf::Value(tinygltf::Value::Object{{"source", tinygltf::Value(source)}});
}

template <class Call>
std::string messageOf(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::to_string(error.exitCode()) + " " + error.what();
  }
  return "accepted";
}

TEST(GltfImages, AMissingNormalMapIsLeftOutAndCounted) {
  tinygltf::Model model = texturedTriangle("");
  model.images[0].uri = "absent.png";
  model.materials[0].pbrMetallicRoughness.baseColorTexture.index = -1;
  model.materials[0].normalTexture.index = 0;
  const SceneFile scene = readScene(model, "a.gltf");
  EXPECT_FALSE(scene.materials.at(0).normalTexture.has_value());
  EXPECT_EQ(scene.images.size(), 0U);
  EXPECT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(scene.ignored, (ContentCounts{{"missing pictures", 1}, {"textures of normals", 1}}));
}

TEST(GltfImages, WebpIsPreferredAndSurvivesEncoding) {
  tinygltf::Model model = texturedTriangle(pngFile({.width = 3}));
  const int webp = addImage(model, webpFile(noisePicture(5, 4), true));
  model.textures[0].extensions["EXT_texture_webp"] = webpExtension(webp);
  model.extensionsUsed = {"EXT_texture_webp"};
  model.extensionsRequired = {"EXT_texture_webp"};
  const std::vector<std::byte> glb = encodeGlb(model);
  const tinygltf::Model read = parseGltf(glb, "a.glb");
  EXPECT_EQ(read.images[1].mimeType, "image/webp");
  EXPECT_EQ(detail::imageOfTexture(read.textures[0]), 1);
  const SceneFile scene = readScene(read, "a.glb");
  ASSERT_EQ(scene.images.size(), 1U);
  EXPECT_EQ(scene.images[0].width, 5U);
  EXPECT_EQ(scene.images[0].height, 4U);
}

TEST(GltfImages, WebpWithoutAnImageIsMalformed) {
  const auto parse = [](const std::string& extension) {
    const std::string text =
        R"({"asset":{"version":"2.0"},"textures":[{"extensions":{"EXT_texture_webp":)" + extension + "}}]}";
    return messageOf([&] { parseGltf(std::as_bytes(std::span(text.data(), text.size())), "a.gltf"); });
  };
  EXPECT_EQ(parse(R"({"source":0})"), "5 a.gltf: textures 0: EXT_texture_webp: index 0 is out of range, there are 0");
  EXPECT_EQ(parse("{}"), "5 a.gltf: EXT_texture_webp without a source");
  EXPECT_EQ(parse(R"({"source":-1})"), "5 a.gltf: \"source\" is not a valid index or size");
  EXPECT_EQ(parse("7"), "5 a.gltf: EXT_texture_webp is no object");
}

/// A picture whose header is right and whose data is not.
std::string brokenPng() {
  std::string bytes = pngFile({});
  bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 1);
  return bytes;
}

TEST(GltfImages, MessagesNameThePicture) {
  tinygltf::Model model = texturedTriangle(brokenPng());
  EXPECT_EQ(messageOf([&] { readScene(model, "a.glb"); }),
            "5 a.glb: image 0: the PNG is broken: IDAT: incorrect data check");
  model.images[0].uri = "wood.png";
  EXPECT_EQ(messageOf([&] { readScene(model, "a.glb"); }),
            "5 a.glb: image 0 (wood.png): the PNG is broken: IDAT: incorrect data check");
}

TEST(GltfImages, CheckDecodesPicturesThatNothingUses) {
  tinygltf::Model model = texturedTriangle(pngFile({}));
  addImage(model, jpegFile({}));
  addImage(model, webpFile(noisePicture(8, 8), false));
  EXPECT_EQ(messageOf([&] { checkImages(model, "a.glb"); }), "accepted");
  addImage(model, brokenPng());
  EXPECT_EQ(messageOf([&] { readScene(model, "a.glb"); }), "accepted");
  EXPECT_EQ(messageOf([&] { checkImages(model, "a.glb"); }),
            "5 a.glb: image 3: the PNG is broken: IDAT: incorrect data check");
}

TEST(GltfImages, PixelsAreBoundedByBytes) {
  ImageRgba8 flat{512, 512, {}};
  flat.pixels.assign(std::size_t{4} * 512 * 512, 255);
  const std::string picture = webpFile(flat, true);
  ASSERT_LT(picture.size(), 100U);
  tinygltf::Model model = texturedTriangle(picture);
  for (int i = 0; i < 100; ++i)
    addImage(model, picture);  // equal pictures are decoded once
  Limits limits;
  limits.maxFreePixels = 512 * 512;
  EXPECT_EQ(messageOf([&] { checkImages(model, "a.glb", limits); }), "accepted");
  limits.maxFreePixels = 100'000;
  const std::string message = messageOf([&] { checkImages(model, "a.glb", limits); });
  EXPECT_TRUE(message.starts_with("7 a.glb: image 0: with it the pictures have 262144 pixels out of")) << message;
}

}  // namespace
}  // namespace jalousie::asset
