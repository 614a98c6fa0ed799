// Runs jalousie-bake with the command lines of users.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "asset/gltf_file.h"
#include "asset/scene_file.h"
#include "bake/bake_fixtures.h"
#include "core/file.h"
#include "support/draco_document.h"
#include "support/run_program.h"

namespace jalousie {
namespace {

using test::ProgramResult;

class BakeProgram : public testing::Test {
 protected:
  BakeProgram() { std::ofstream(folder_ / "ball.ply") << test::spherePly(40, 20); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  static ProgramResult bake(std::vector<std::string> arguments) {
    return test::runProgram(JALOUSIE_BAKE_PROGRAM, arguments);
  }
  void expectRefused(const std::vector<std::string>& arguments, int exitCode, const std::string& mention) {
    const ProgramResult result = bake(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.standardError;
    EXPECT_EQ(std::count(result.standardError.begin(), result.standardError.end(), '\n'), 1) << result.standardError;
    EXPECT_NE(result.standardError.find(mention), std::string::npos) << result.standardError;
    EXPECT_FALSE(std::filesystem::exists(file("out.glb")));
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(BakeProgram, HelpHasExamples) {
  const ProgramResult help = bake({"--help"});
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_NE(help.standardOutput.find("Examples"), std::string::npos);
}

TEST_F(BakeProgram, ReportAndFileAgree) {
  const ProgramResult result =
      bake({file("ball.ply"), "-o", file("out.glb"), "--levels", "4", "--subdivide", "1", "--json", file("r.json")});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const nlohmann::json report = nlohmann::json::parse(std::ifstream(file("r.json")));
  const auto& levels = report["meshes"][0]["levels"];
  ASSERT_EQ(levels.size(), 4U);
  EXPECT_EQ(levels[0]["triangles"], 2 * 40 * 19 * 4);
  const asset::SceneFile scene = asset::readSceneFile(file("out.glb"));
  ASSERT_EQ(scene.chains.size(), 1U);
  for (std::size_t k = 0; k < 4; ++k) {
    const asset::LodLevel& level = scene.chains[0].levels[k];
    EXPECT_EQ(scene.meshes[level.mesh].primitives[0].indices.size() / 3, levels[k]["triangles"].get<std::size_t>());
    EXPECT_FLOAT_EQ(level.errorObject, levels[k]["error_object"].get<float>());
  }
}

TEST_F(BakeProgram, CellsAreDividedReportedAndReadAgain) {
  ASSERT_EQ(bake({file("ball.ply"), "-o", file("out.glb"), "--levels", "3", "--cells", "100", "--quantize",
                  "--compress", "--json", file("r.json")})
                .exitCode,
            0);
  // 1520 triangles: 16 cells of 95
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(file("r.json")))["meshes"][0]["cells"], 16);
  const nlohmann::json inspected =
      nlohmann::json::parse(bake({"inspect", file("out.glb"), "--json"}).standardOutput)["chains"][0]["levels"];
  EXPECT_EQ(inspected[0]["cells"], nlohmann::json({{"count", 16}, {"filled", 16}, {"largest", 95}, {"mean", 95.0}}));
  EXPECT_EQ(inspected[2]["cells"]["count"], 16);
  EXPECT_LT(inspected[2]["cells"]["filled"], 16);
  const asset::SceneFile scene = asset::readSceneFile(file("out.glb"));
  for (const asset::LodLevel& level : scene.chains.at(0).levels)
    EXPECT_EQ(scene.meshes[level.mesh].primitives[0].cellEnds.size(), 16U);
  ASSERT_EQ(bake({file("ball.ply"), "-o", file("out.glb"), "-q", "--cells", "off"}).exitCode, 0);
  EXPECT_TRUE(asset::readSceneFile(file("out.glb")).meshes[0].primitives[0].cellEnds.empty());
}

TEST_F(BakeProgram, DracoIsReadAndNotWritten) {
  const test::DracoSheet sheet = test::dracoSheet(12);
  const std::string stream = test::dracoStream(sheet, test::DracoMethod::kEdgebreaker);
  nlohmann::json document = test::dracoDocument(sheet, stream);
  const auto write = [&] {
    std::ofstream(file("stream.bin"), std::ios::binary) << stream;
    document["buffers"][0]["uri"] = "stream.bin";
    std::ofstream(file("draco.gltf")) << document.dump();
  };
  write();
  const ProgramResult result = bake({file("draco.gltf"), "-o", file("out.glb"), "-q", "--levels", "3"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  const asset::SceneFile scene = asset::readSceneFile(file("out.glb"));
  EXPECT_EQ(scene.meshes.at(0).primitives.at(0).indices.size(), 3 * sheet.triangles.size());
  EXPECT_EQ(scene.chains.at(0).levels.size(), 3U);
  const tinygltf::Model model = asset::loadGltf(file("out.glb"));
  EXPECT_TRUE(model.extensionsRequired.empty());
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{"MSFT_lod"});
  std::filesystem::remove(file("out.glb"));
  document["accessors"][5]["count"] = 861;
  write();
  expectRefused({file("draco.gltf"), "-o", file("out.glb")}, 5, "288 triangles in the stream, 287 in the accessors");
}

TEST_F(BakeProgram, OnlyNumbersWithinTheRangeAutoAndOffAreCells) {
  for (const char* good : {"64", "65536", "AUTO", "Off"}) {
    const ProgramResult result = bake({file("missing.ply"), "-o", file("out.glb"), "--cells", good});
    EXPECT_EQ(result.exitCode, 3) << good << ": " << result.standardError;
  }
  for (const char* bad : {"63", "65537", "-64", "100.5", "1e3", "all", "0", "64x"})
    expectRefused({file("ball.ply"), "-o", file("out.glb"), "--cells", bad}, 2,
                  std::string("--cells: ") + bad + " is not auto, off or 64..65536");
  expectRefused({file("ball.ply"), "-o", file("out.glb"), "--cells", ""}, 2, "--cells");
}

TEST_F(BakeProgram, InspectAndSheetShowTheBake) {
  ASSERT_EQ(
      bake({file("ball.ply"), "-o", file("out.glb"), "--levels", "3", "--sheet", file("sheet.html"), "-q"}).exitCode,
      0);
  EXPECT_GT(std::filesystem::file_size(file("sheet.html")), 10000U);
  const ProgramResult text = bake({"inspect", file("out.glb")});
  EXPECT_EQ(text.exitCode, 0) << text.standardError;
  EXPECT_NE(text.standardOutput.find("ball: 3 levels"), std::string::npos);
  const ProgramResult json = bake({"inspect", file("out.glb"), "--json"});
  EXPECT_EQ(nlohmann::json::parse(json.standardOutput)["chains"][0]["levels"].size(), 3U);
  EXPECT_EQ(bake({"inspect", file("missing.glb")}).exitCode, 3);
  EXPECT_EQ(bake({"inspect"}).exitCode, 2);
}

TEST_F(BakeProgram, ErrorsAreTargetsAlsoInQuantisedFiles) {
  for (const bool quantize : {false, true}) {
    std::vector<std::string> arguments = {file("ball.ply"), "-o",     file("out.glb"), "--error",
                                          "0.5%,2,10%",     "--json", file("r.json")};
    if (quantize) arguments.emplace_back("--quantize");
    const ProgramResult result = bake(arguments);
    ASSERT_EQ(result.exitCode, 0) << result.standardError;
    EXPECT_EQ(result.standardError, "");  // a short bake needs no sign of life
    EXPECT_NE(result.standardOutput.find("target %"), std::string::npos);
    EXPECT_NE(bake({"inspect", file("out.glb")}).standardOutput.find("target %"), std::string::npos);
    const nlohmann::json report = nlohmann::json::parse(std::ifstream(file("r.json")))["meshes"][0]["levels"];
    const nlohmann::json levels =
        nlohmann::json::parse(bake({"inspect", file("out.glb"), "--json"}).standardOutput)["chains"][0]["levels"];
    ASSERT_EQ(levels.size(), 4U);
    EXPECT_FALSE(levels[0].contains("target_percent"));
    const double targets[] = {0.5, 2.0, 10.0};
    for (std::size_t k = 1; k < 4; ++k) {
      EXPECT_NEAR(levels[k]["target_percent"].get<double>(), targets[k - 1], 1e-6);
      EXPECT_NEAR(report[k]["target_percent"].get<double>(), targets[k - 1], 1e-6);
      EXPECT_LE(levels[k]["error_percent"].get<double>(), targets[k - 1] * (1.0 + 1e-9)) << quantize;
    }
  }
}

TEST_F(BakeProgram, ErrorsStandAloneAndAscend) {
  const auto refuse = [&](const char* errors, std::vector<std::string> more, const std::string& mention) {
    more.insert(more.begin(), {file("ball.ply"), "-o", file("out.glb"), "--error", errors});
    expectRefused(more, 2, mention);
  };
  for (const char* other : {"--levels", "--coarsest", "--until-error"})
    refuse("1%", {other, "5"}, std::string("leave out ") + other);
  for (const char* other : {"--ratio", "--ratios"})
    refuse("1%", {other, "0.5"}, std::string("leave out ") + other);
  refuse("2,1", {}, "--error must ascend");
  refuse("1,1", {}, "--error must ascend");
  for (const char* bad : {"0", "-1", "101", "nan", "1%%", "%", "1e", "x"})
    refuse(bad, {}, std::string(bad) + " is not a percentage above 0, at most 100");
  refuse("1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16", {}, "at most 15 levels");
}

TEST_F(BakeProgram, SeveralInputsBecomeSeveralNodesInOrder) {
  std::ofstream(file("quad.obj")) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  ASSERT_EQ(bake({file("ball.ply"), file("quad.obj"), "-o", file("out.glb"), "-q"}).exitCode, 0);
  const tinygltf::Model model = asset::loadGltf(file("out.glb"));
  ASSERT_EQ(model.scenes[0].nodes.size(), 2U);
  EXPECT_EQ(model.nodes[0].name, "ball");
  EXPECT_EQ(model.nodes[1].name, "quad");
}

TEST_F(BakeProgram, SameBytesEveryTime) {
  ASSERT_EQ(bake({file("ball.ply"), "-o", file("a.glb")}).exitCode, 0);
  ASSERT_EQ(bake({file("ball.ply"), "-o", file("b.glb")}).exitCode, 0);
  const auto text = [&](const char* name) {
    std::ifstream stream(file(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_EQ(text("a.glb"), text("b.glb"));
}

TEST_F(BakeProgram, SameBytesOnOneCore) {
  if (!std::filesystem::exists("/usr/bin/taskset")) GTEST_SKIP() << "taskset is not installed";
  for (const char* preset : {"best", "fast", "draft"}) {
    ASSERT_EQ(bake({file("ball.ply"), "-o", file("all.glb"), "--preset", preset}).exitCode, 0);
    const ProgramResult one = test::runProgram("/usr/bin/taskset", {"-c", "0", JALOUSIE_BAKE_PROGRAM, file("ball.ply"),
                                                                    "-o", file("one.glb"), "--preset", preset});
    if (one.exitCode == 1) GTEST_SKIP() << "core 0 is not ours: " << one.standardError;
    EXPECT_EQ(readFile(file("all.glb"), 1U << 30U), readFile(file("one.glb"), 1U << 30U)) << preset;
  }
}

TEST_F(BakeProgram, BadInputIsOneLineACodeAndNothingWritten) {
  std::ofstream(file("broken.ply")) << "ply\nformat ascii 1.0\nelement vertex 99\n";
  std::ofstream(file("notes.txt")) << "hello";
  expectRefused({file("missing.ply"), "-o", file("out.glb")}, 3, "missing.ply");
  expectRefused({file(""), "-o", file("out.glb")}, 2, "name a folder");
  expectRefused({file("broken.ply"), "-o", file("out.glb")}, 5, "broken.ply");
  expectRefused({file("notes.txt"), "-o", file("out.glb")}, 6, "notes.txt");
  expectRefused({file("ball.ply"), file("broken.ply"), "-o", file("out.glb")}, 5, "broken.ply");
  expectRefused({file("ball.ply"), "-o", file("no/folder/out.glb")}, 8, "out.glb");
  expectRefused({file("ball.ply")}, 2, "--output");
  expectRefused({file("ball.ply"), "-o", file("out.glb"), "--levels", "0"}, 2, "--levels");
  expectRefused({file("ball.ply"), "-o", file("out.glb"), "--ratio", "0.5", "--coarsest", "9"}, 2, "--ratio");
  expectRefused({file("ball.ply"), "-o", file("out.glb"), "--ratios", "0.5,2"}, 2, "--ratios");
  expectRefused({file("ball.ply"), "-o", file("out.glb"), "--ratios", "0.25,0.5"}, 2, "--ratios");
  expectRefused({file("ball.ply"), "-o", file("out.glb"), "--preset", "finest"}, 2, "--preset");
  expectRefused({file("ball.ply"), "-o", file("out.glb"), "--preset", "draft", "--weight-uv", "2"}, 2, "--weight-uv");
  expectRefused({file("ball.ply"), "-o", file("out.glb"), "--preset", "draft", "--budget", "scene"}, 2, "--budget");
  for (const char* name : {"out.gltf", "out.PNG"})
    expectRefused({file("ball.ply"), "-o", file(name)}, 2, "ends in .glb");
}

TEST_F(BakeProgram, NumbersThatAreNoneAreRefused) {
  for (const char* option : {"--ratio", "--ratios", "--until-error", "--pixels", "--hard-angle", "--weight-uv",
                             "--weight-normal", "--timeout", "--weld"}) {
    expectRefused({file("ball.ply"), "-o", file("out.glb"), option, "nan"}, 2, std::string(option) + ": Value nan");
  }
  for (const char* distance : {"0", "-1", "inf"})
    expectRefused({file("ball.ply"), "-o", file("out.glb"), "--weld", distance}, 2, "is no number above 0");
}

TEST_F(BakeProgram, WhatIsLeftOutIsSaidOnceForEachKind) {
  std::ofstream(file("cup.obj"))
      << "mtllib absent.mtl\nmtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl clay\nf 1 2 3\n";
  const std::string expected = "a material file is missing or cannot be read: absent.mtl and 1 more";
  for (const char* run : {"first", "cached"}) {
    const ProgramResult result =
        bake({file("cup.obj"), "-o", file("cup.glb"), "--json", file("r.json"), "--cache", file("cache"), "-q"});
    ASSERT_EQ(result.exitCode, 0) << result.standardError;
    EXPECT_EQ(result.standardError, "jalousie-bake: warning: " + file("cup.obj") + ": " + expected + "\n") << run;
    const nlohmann::json report = nlohmann::json::parse(std::ifstream(file("r.json")));
    EXPECT_EQ(report["warnings"], nlohmann::json::array({expected}));
  }
}

}  // namespace
}  // namespace jalousie
