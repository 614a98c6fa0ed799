// What the baker writes, in the readers of others: Babylon.js builds every level of every chain, three.js shows LOD 0,
// the Khronos validator finds nothing in the output that it did not find in the input.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "asset/accessor.h"
#include "asset/gltf_file.h"
#include "support/node.h"
#include "support/run_program.h"
#include "support/scenes.h"
#include "support/source_root.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Readers : public testing::Test {
 protected:
  void SetUp() override {
    node_ = test::findNode();
    if (!node_) GTEST_SKIP() << "Node.js is not installed";
  }
  /// A package of assets/fetch; skips without it.
  std::string package(const std::string& name) const {
    const fs::path folder = test::kSourceRoot / "assets/fetched" / name;
    return fs::exists(folder) ? folder.string() : std::string();
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  json run(const char* script, const std::string& folder, const fs::path& input) const {
    const test::ProgramResult result =
        test::runProgram(*node_, {(test::kSourceRoot / "tests/project" / script).string(), folder, input.string()});
    EXPECT_EQ(result.exitCode, 0) << input << result.standardError;
    return result.exitCode == 0 ? json::parse(result.standardOutput) : json();
  }
  /// The report of a bake with these options.
  json bake(const std::string& input, const std::string& output, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {input, "-o", output, "--preset", "draft", "--json", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const test::ProgramResult result = test::runProgram(JALOUSIE_BAKE_PROGRAM, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.standardError;
    return json::parse(result.standardOutput);
  }
  static std::vector<fs::path> realScenes() {
    std::vector<fs::path> files;
#if defined(__SANITIZE_ADDRESS__)
    return files;  // baking them takes minutes, and the other build does it
#endif
    if (const char* folder = std::getenv("JALOUSIE_SCENES"))
      for (const char* scene : {"candela_city/scene.gltf", "cornfield_crossing/scene.gltf"})
        if (fs::exists(fs::path(folder) / scene)) files.push_back(fs::path(folder) / scene);
    return files;
  }

  const test::TemporaryFolder folder_;

 private:
  std::optional<fs::path> node_;
};

const std::vector<std::vector<std::string>> kEncodings = {
    {}, {"--quantize"}, {"--compress"}, {"--quantize", "--compress"}};

TEST_F(Readers, BabylonBuildsEveryLevel) {
  const std::string babylon = package("babylon");
  if (babylon.empty()) GTEST_SKIP() << "Babylon.js is not here; assets/fetch babylon gets it from the npm registry";
  std::ofstream(file("ball.ply")) << test::spherePly(32, 16);
  for (const std::vector<std::string>& options : kEncodings) {
    const json report = bake(file("ball.ply"), file("ball.glb"), options);
    const json read = run("babylon_check.cjs", babylon, file("ball.glb"));
    EXPECT_EQ(read["errors"], json::array());
    EXPECT_EQ(read["warnings"], json::array());
    ASSERT_EQ(read["chains"].size(), 1U);
    const json& levels = report["meshes"][0]["levels"];
    ASSERT_EQ(read["chains"][0]["levels"].size(), levels.size());
    EXPECT_GE(levels.size(), 4U);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      EXPECT_EQ(read["chains"][0]["levels"][k]["triangles"], levels[k]["triangles"]) << k;
      EXPECT_FLOAT_EQ(read["chains"][0]["levels"][k]["screenCoverage"].get<float>(),
                      levels[k]["screen_coverage"].get<float>());
    }
  }
}

/// Two boxes of many squares at x = 1, the second a child of the first and above it.
std::string bodyWithHead() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  const asset::Primitive ball = test::sphere(24, 12);
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, ball.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, ball.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = asset::appendIndices(model, ball.indices);
  model.meshes.resize(1);
  model.meshes[0].primitives = {primitive};
  model.nodes.resize(2);
  model.nodes[0].mesh = 0;
  model.nodes[0].translation = {1, 0, 0};
  model.nodes[0].children = {1};
  model.nodes[1].mesh = 0;
  model.nodes[1].translation = {0, 3, 0};
  model.scenes.resize(1);
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
  const std::vector<std::byte> bytes = asset::encodeGlb(model);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(Readers, ChildrenStayAtEveryLevel) {
  const std::string babylon = package("babylon");
  const std::string three = package("three");
  if (babylon.empty() || three.empty()) GTEST_SKIP() << "assets/fetch babylon three gets them from the npm registry";
  std::ofstream(file("body.glb"), std::ios::binary) << bodyWithHead();
  for (const std::vector<std::string>& options : kEncodings) {
    const json report = bake(file("body.glb"), file("out.glb"), options);
    const json read = run("babylon_check.cjs", babylon, file("out.glb"));
    EXPECT_EQ(read["errors"], json::array());
    ASSERT_EQ(read["chains"].size(), 2U);
    for (const json& chain : read["chains"]) {
      ASSERT_EQ(chain["levels"].size(), report["meshes"][0]["levels"].size());
      const double low = chain["levels"][0]["boundingBox"][0][1];
      for (const json& level : chain["levels"]) {
        const double middle =
            0.5 * (level["boundingBox"][0][0].get<double>() + level["boundingBox"][1][0].get<double>());
        EXPECT_NEAR(middle, 1.0, 0.6);  // in the place of its parent
        EXPECT_NEAR(level["boundingBox"][0][1].get<double>(), low, 0.6);
      }
    }
    const json shown = run("three_check.mjs", three, file("out.glb"));
    EXPECT_EQ(shown["triangles"], 2 * report["meshes"][0]["levels"][0]["triangles"].get<int>());
    EXPECT_NEAR(shown["boundingBox"][1][1].get<double>(), 4.0, 0.01);
    EXPECT_NEAR(shown["boundingBox"][0][0].get<double>(), 0.0, 0.01);
  }
}

TEST_F(Readers, BabylonReadsTheGameScenes) {
  const std::string babylon = package("babylon");
  if (babylon.empty()) GTEST_SKIP() << "Babylon.js is not here; assets/fetch babylon gets it from the npm registry";
  if (realScenes().empty()) GTEST_SKIP() << "JALOUSIE_SCENES names no folder with the scenes";
  for (const fs::path& scene : realScenes()) {
    std::size_t chains = 0;
    const json report = bake(scene.string(), file("scene.glb"), {});
    for (const json& mesh : report["meshes"])
      chains += mesh["levels"].size() > 1 ? mesh["nodes"].get<std::size_t>() : 0U;
    const json read = run("babylon_check.cjs", babylon, file("scene.glb"));
    EXPECT_EQ(read["errors"], json::array()) << scene;
    EXPECT_EQ(read["chains"].size(), chains) << scene;
    for (const json& chain : read["chains"])
      for (std::size_t k = 1; k < chain["levels"].size(); ++k)
        EXPECT_LT(chain["levels"][k]["triangles"], chain["levels"][k - 1]["triangles"]) << chain["name"];
  }
}

TEST_F(Readers, ThreeLoadsTheFinestLevel) {
  const std::string three = package("three");
  if (three.empty()) GTEST_SKIP() << "three.js is not here; assets/fetch three gets it from the npm registry";
  std::ofstream(file("ball.ply")) << test::spherePly(32, 16);
  for (const std::vector<std::string>& options : kEncodings) {
    const json report = bake(file("ball.ply"), file("ball.glb"), options);
    const json read = run("three_check.mjs", three, file("ball.glb"));
    EXPECT_EQ(read["warnings"], json::array());
    EXPECT_EQ(read["triangles"], report["meshes"][0]["levels"][0]["triangles"]);
    EXPECT_NEAR(read["boundingBox"][1][1].get<double>() - read["boundingBox"][0][1].get<double>(), 2.0, 0.01);
  }
  for (const fs::path& scene : realScenes()) {
    std::uint64_t triangles = 0;
    const json report = bake(scene.string(), file("scene.glb"), {});
    for (const json& mesh : report["meshes"])
      if (!mesh["levels"].empty())
        triangles += mesh["nodes"].get<std::uint64_t>() * mesh["levels"][0]["triangles"].get<std::uint64_t>();
    const json read = run("three_check.mjs", three, file("scene.glb"));
    EXPECT_GE(read["triangles"].get<std::uint64_t>(), triangles) << scene << ": meshes passed through come on top";
  }
}

TEST_F(Readers, ValidatorFindsNothingNew) {
  const std::string validator = package("gltf-validator");
  if (validator.empty())
    GTEST_SKIP() << "the validator is not here; assets/fetch validator gets it from the npm registry";
  if (realScenes().empty()) GTEST_SKIP() << "JALOUSIE_SCENES names no folder with the scenes";
  for (const fs::path& scene : realScenes()) {
    const json before = run("validate.js", validator, scene);
    for (const std::vector<std::string>& options : {kEncodings.front(), kEncodings.back()}) {
      bake(scene.string(), file("scene.glb"), options);
      const json after = run("validate.js", validator, file("scene.glb"));
      EXPECT_EQ(after["numErrors"], 0) << scene << after.dump(1);
      EXPECT_LE(after["numWarnings"], before["numWarnings"]) << scene << after.dump(1);
    }
  }
}

}  // namespace
}  // namespace jalousie
