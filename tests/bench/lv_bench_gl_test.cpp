// lv_bench prove from command line to table, on a small crowd.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/scenes.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class LvBenchProve : public testing::Test {
 protected:
  /// Thirty spheres of 3,968 triangles, so that they are divided into cells.
  void SetUp() override {
    std::ofstream(file("sphere.ply")) << test::spherePly(64, 32);
    run(JALOUSIE_BAKE_PROGRAM, {file("sphere.ply"), "-o", file("sphere.glb"), "--quiet", "--preset", "draft"});
    run(JALOUSIE_SCATTER_PROGRAM, {file("sphere.glb"), "-o", file("crowd.glb"), "--quiet", "--count", "30"});
  }
  std::string file(const char* name) const { return (folder_.path() / name).string(); }
  static std::string run(const char* program, const std::vector<std::string>& arguments) {
    const test::ProgramResult result = test::runProgram(program, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.standardError;
    return result.standardOutput;
  }
  static json readJson(const std::string& path) {
    std::ifstream stream(path);
    return json::parse(stream);
  }

  test::TemporaryFolder folder_;
};

TEST_F(LvBenchProve, MeasuresTheChosenCandidatesAndJoinsTables) {
  const std::string table =
      run(JALOUSIE_LV_BENCH, {"prove", file("crowd.glb"), "900", "--only", "still", "--candidates",
                              "price,pixel-error+cells", "--json", file("prove.json")});
  EXPECT_NE(table.find("| crowd | 900 | pixel-error+cells |"), std::string::npos) << table;
  const json figures = readJson(file("prove.json"))["figures"];
  ASSERT_EQ(figures["rows"].size(), 2U);
  ASSERT_EQ(figures["sweeps"].size(), 3U) << "the baseline is measured too";
  const json& price = figures["rows"][0];
  const json& cells = figures["rows"][1];
  EXPECT_EQ(cells["wrong_pixels"], 0) << "cells must not change a picture";
  EXPECT_TRUE(price["wrong_pixels"].is_null());
  for (const char* measure : {"psnr", "ssim", "flip"}) {
    EXPECT_GT(price["still"][measure], 0.0) << measure;
    EXPECT_LE(cells["still"][measure], 1.0) << measure << ": cells draw a part of the same triangles";
  }
  EXPECT_TRUE(cells["moving"].empty());
  EXPECT_GT(cells["frame_ratio"], 0.0);
  // FLIP falls where tau falls.
  const json& baseline = figures["sweeps"][0]["still"];
  EXPECT_LT(baseline.back()[4], baseline.front()[4]);

  run(JALOUSIE_LV_BENCH, {"prove-table", file("prove.json"), file("prove.json"), "--json", file("both.json")});
  const json both = readJson(file("both.json"))["figures"];
  ASSERT_EQ(both["rows"].size(), 4U);
  EXPECT_EQ(both["means"][0]["views"], 2);
  EXPECT_NEAR(both["means"][0]["still"]["psnr"].get<double>(), price["still"]["psnr"].get<double>(), 1e-9)
      << "the mean of a value and itself";
}

TEST_F(LvBenchProve, WrongUseIsOneLine) {
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const char* reason) {
    const test::ProgramResult result = test::runProgram(JALOUSIE_LV_BENCH, arguments);
    EXPECT_EQ(result.exitCode, code);
    EXPECT_NE(result.standardError.find(reason), std::string::npos) << result.standardError;
  };
  refused({"worth", file("crowd.glb"), "900", "--only", "still"}, 2, "--only and --candidates are options of prove");
  refused({"prove", file("crowd.glb"), "900", "--candidates", "thesis"}, 2, "thesis not in");
  refused({"prove", file("crowd.glb")}, 2, "a VIEW is needed");
  refused({"prove-table", file("sphere.ply")}, 5, "not written by lv_bench prove");
  refused({"prove-table", file("missing.json")}, 3, "cannot be opened");
}

}  // namespace
}  // namespace jalousie
