// bench/place_models.mjs: scenes of bench/prove are made of models that it joins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/run_program.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string word(std::uint32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}

/// One triangle in the box from (0, 0, 0) to (2, 4, 1), with a texture that a material refers to.
void writeModel(const fs::path& file) {
  const float positions[] = {0, 0, 0, 2, 0, 1, 0, 4, 0};
  std::string binary(sizeof(positions), '\0');
  std::memcpy(binary.data(), positions, sizeof(positions));
  json document = {
      {"asset", {{"version", "2.0"}}},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"material", 0}}}}}}},
      {"materials", {{{"name", "bark"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}}},
      {"textures", {{{"source", 0}}}},
      {"images", {{{"uri", "data:image/png;base64,"}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", 3},
         {"type", "VEC3"},
         {"min", {0, 0, 0}},
         {"max", {2, 4, 1}}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteLength", binary.size()}}}},
      {"buffers", {{{"byteLength", binary.size()}}}},
  };
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::ofstream(file, std::ios::binary) << "glTF" << word(2)
                                        << word(static_cast<std::uint32_t>(28 + text.size() + binary.size()))
                                        << word(static_cast<std::uint32_t>(text.size())) << word(0x4E4F534A) << text
                                        << word(static_cast<std::uint32_t>(binary.size())) << word(0x004E4942)
                                        << binary;
}

json readJson(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  return json::parse(bytes.substr(20, length));
}

class PlaceModels : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::findProgram("node")) GTEST_SKIP() << "Node.js is not installed";
    writeModel(folder_.path() / "model.glb");
  }
  test::ProgramResult place(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), out().string());
    return test::runProgram(fs::path(JALOUSIE_SOURCE_DIR) / "bench/place_models.mjs", arguments);
  }
  std::string model() const { return (folder_.path() / "model.glb").string(); }
  fs::path out() const { return folder_.path() / "scene.glb"; }

  test::TemporaryFolder folder_;
};

TEST_F(PlaceModels, TwoFilesAreJoinedWithTheirOwnIndices) {
  const test::ProgramResult result = place({"field", "2", "1", "10", model() + "=8", model() + "=4"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const json scene = readJson(out());
  ASSERT_EQ(scene["meshes"].size(), 3U) << "two models and the ground";
  const json& second = scene["meshes"][1]["primitives"][0];
  EXPECT_EQ(second["attributes"]["POSITION"], 1);
  EXPECT_EQ(scene["accessors"][1]["bufferView"], 1);
  EXPECT_EQ(scene["bufferViews"][1]["byteOffset"], 36);
  EXPECT_EQ(
      scene["materials"][second["material"].get<std::size_t>()]["pbrMetallicRoughness"]["baseColorTexture"]["index"],
      1);
  EXPECT_EQ(scene["textures"][1]["source"], 1);
}

TEST_F(PlaceModels, ModelsStandOnTheGroundWithTheSizeThatWasAskedFor) {
  ASSERT_EQ(place({"rooms", "1", "1", "6", model() + "=2"}).exitCode, 0);
  const json scene = readJson(out());
  int models = 0;
  for (const json& node : scene["nodes"]) {
    if (node["mesh"] != 0) continue;
    ++models;
    const auto matrix = node["matrix"].get<std::vector<double>>();
    EXPECT_NEAR(matrix[5], 0.5, 1e-12) << "4 units high become 2 meters";
    EXPECT_NEAR(matrix[13], 0.0, 1e-12);
    // The middle of the box, (1, 0, 0.5), is in one quarter of the room.
    EXPECT_NEAR(std::abs(matrix[0] + 0.5 * matrix[8] + matrix[12]), 0.27 * 6, 1e-9);
    EXPECT_NEAR(std::abs(matrix[2] + 0.5 * matrix[10] + matrix[14]), 0.27 * 6, 1e-9);
  }
  EXPECT_EQ(models, 4);
}

TEST_F(PlaceModels, MaterialsGetThePicturesOfAnMtlFile) {
  std::ofstream(folder_.path() / "picture.png") << "12345";
  std::ofstream(folder_.path() / "model.mtl")
      << "newmtl other\nmap_Kd picture.png\nnewmtl wood\nmap_Kd missing.png\nnewmtl bark\nmap_Kd picture.png\n";
  const std::string mtl = (folder_.path() / "model.mtl").string();
  const test::ProgramResult result = place({"field", "1", "1", "10", model() + "," + mtl + "=8"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const json scene = readJson(out());
  const json& bark = scene["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  const json& image = scene["images"][scene["textures"][bark["index"].get<std::size_t>()]["source"].get<std::size_t>()];
  EXPECT_EQ(image["mimeType"], "image/png");
  EXPECT_EQ(scene["bufferViews"][image["bufferView"].get<std::size_t>()]["byteLength"], 5);
}

TEST_F(PlaceModels, TheSameArgumentsGiveTheSameScene) {
  ASSERT_EQ(place({"field", "3", "3", "5", model() + "=2"}).exitCode, 0);
  const json first = readJson(out());
  ASSERT_EQ(place({"field", "3", "3", "5", model() + "=2"}).exitCode, 0);
  EXPECT_EQ(readJson(out()), first);
}

TEST_F(PlaceModels, WrongArgumentsAreOneLine) {
  for (const auto& [arguments, reason] :
       {std::pair{std::vector<std::string>{"field", "0", "1", "5", model() + "=2"}, "two counts of 1 to 100"},
        std::pair{std::vector<std::string>{"heap", "1", "1", "5", model() + "=2"}, "field or rooms"},
        std::pair{std::vector<std::string>{"field", "1", "1", "5", model()}, "is not FILE.glb=SIZE"}}) {
    const test::ProgramResult result = place(arguments);
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.standardError.find(reason), std::string::npos) << result.standardError;
    EXPECT_EQ(std::ranges::count(result.standardError, '\n'), 1) << result.standardError;
  }
}

}  // namespace
}  // namespace jalousie
