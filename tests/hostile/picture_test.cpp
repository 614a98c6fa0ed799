// Broken pictures given to the programs: the right exit code and one line that names the file and the reason, little
// time and memory, no signal.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "asset/accessor.h"
#include "asset/gltf_file.h"
#include "support/broken_pictures.h"
#include "support/picture_writer.h"
#include "support/run_program.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;
using test::BrokenPicture;
using test::ProgramResult;

constexpr std::uint64_t kMaxBytes = 256ULL << 20U;
constexpr double kMaxCpuSeconds = 5.0;

void writeFile(const fs::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// A triangle whose base colour is a picture, whatever its bytes are.
void writeTriangle(const fs::path& file, const std::string& picture) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  tinygltf::Image image;
  image.image.assign(picture.begin(), picture.end());
  image.image.resize(std::max<std::size_t>(image.image.size(), 1));
  image.mimeType = "image/png";
  model.images.push_back(std::move(image));
  model.textures.emplace_back();
  model.textures[0].source = 0;
  model.materials.emplace_back();
  model.materials[0].pbrMetallicRoughness.baseColorTexture.index = 0;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  const std::array<glm::vec3, 3> positions = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const std::array<glm::vec2, 3> uvs = {{{0, 0}, {1, 0}, {0, 1}}};
  primitive.attributes["POSITION"] = asset::appendVec3(model, positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["TEXCOORD_0"] = asset::appendVec2(model, uvs, TINYGLTF_TARGET_ARRAY_BUFFER);
  model.meshes.emplace_back();
  model.meshes[0].primitives.push_back(std::move(primitive));
  model.nodes.emplace_back();
  model.nodes[0].mesh = 0;
  model.scenes.emplace_back();
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
  asset::saveGlb(model, file);
}

class BrokenPicturePrograms : public testing::Test {
 protected:
  /// @param inside  the picture is inside another file, as image 0
  void expectRefused(const fs::path& program, const std::vector<std::string>& arguments, const fs::path& named,
                     const BrokenPicture& picture, bool inside) {
    const ProgramResult result = test::runProgram(program, arguments, {.environment = {"ASAN_OPTIONS=detect_leaks=0"}});
    SCOPED_TRACE(testing::Message() << picture.name << ", " << program.filename() << " " << arguments[0]);
    const std::string& line = result.standardError;
    EXPECT_EQ(result.exitCode, static_cast<int>(picture.code)) << line;
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
    EXPECT_NE(line.find(named.string() + ": " + (inside ? "image 0: " : "")), std::string::npos) << line;
    EXPECT_NE(line.find(picture.reason), std::string::npos) << line;
    EXPECT_LT(result.cpuSeconds, kMaxCpuSeconds);
#if !defined(__SANITIZE_ADDRESS__)  // whose own memory would count
    EXPECT_LT(result.peakBytes, kMaxBytes);
#endif
    EXPECT_FALSE(fs::exists(frame_));
    EXPECT_FALSE(fs::exists(baked_));
  }

  void SetUp() override {
    writeTriangle(scene_, test::pngFile({}));
  }

  const test::TemporaryFolder folder_;
  const fs::path scene_ = folder_ / "scene.glb";
  const fs::path frame_ = folder_ / "frame.png";
  const fs::path baked_ = folder_ / "baked.glb";
};

TEST_F(BrokenPicturePrograms, WellFormedOnesPass) {
  const fs::path picture = folder_ / "picture.jpg";
  writeFile(picture, test::jpegFile({.colours = test::JpegColours::kYcck, .progressive = true}));
  const std::vector<std::vector<std::string>> runs = {
      {"diff", picture.string(), picture.string()},
      {"render", scene_.string(), "-o", frame_.string(), "--size", "64x64", "--importance", picture.string()}};
  for (const auto& arguments : runs)
    EXPECT_EQ(test::runProgram(JALOUSIE_PROGRAM, arguments).exitCode, 0) << arguments[0];
  EXPECT_EQ(test::runProgram(JALOUSIE_BAKE_PROGRAM, {scene_.string(), "-o", baked_.string(), "-q"}).exitCode, 0);
}

TEST_F(BrokenPicturePrograms, EveryProgramRefusesThem) {
  for (const BrokenPicture& picture : test::brokenPictures()) {
    const fs::path file = folder_ / picture.name;
    const fs::path model = folder_ / (picture.name + ".glb");
    writeFile(file, picture.bytes);
    writeTriangle(model, picture.bytes);
    expectRefused(JALOUSIE_PROGRAM, {"diff", file.string(), file.string()}, file, picture, false);
    expectRefused(JALOUSIE_PROGRAM, {"render", model.string(), "-o", frame_.string()}, model, picture, true);
    expectRefused(JALOUSIE_PROGRAM,
                  {"render", scene_.string(), "-o", frame_.string(), "--size", "64x64", "--importance", file.string()},
                  file, picture, false);
    expectRefused(JALOUSIE_BAKE_PROGRAM, {model.string(), "-o", baked_.string(), "-q"}, model, picture, true);
  }
}

TEST_F(BrokenPicturePrograms, TheBakerDecodesAllOfThem) {
  // A flipped bit in the sum of the compressed data: the header says nothing about it.
  std::string bytes = test::pngFile({.width = 64, .height = 64});
  bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 1);
  const BrokenPicture picture{"late.png", bytes, ErrorCode::kMalformed, "IDAT: incorrect data check"};
  const fs::path model = folder_ / "late.glb";
  writeTriangle(model, bytes);
  expectRefused(JALOUSIE_BAKE_PROGRAM, {model.string(), "-o", baked_.string(), "-q"}, model, picture, true);
  expectRefused(JALOUSIE_SCATTER_PROGRAM, {model.string(), "-o", baked_.string(), "--count", "4", "-q"}, model, picture,
                true);
}

}  // namespace
}  // namespace jalousie
