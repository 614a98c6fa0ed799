// Runs jalousie-wad: output, report, exit codes, one line per failure.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "support/run_program.h"
#include "wad/wad_fixtures.h"

namespace jalousie::wad {
namespace {

class WadProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) / "jalousie_wad_test";
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    writeFileAtomic(folder_ / "house.wad", test::wadOf(test::houseLevel()));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const char* name) const { return (folder_ / name).string(); }
  jalousie::test::ProgramResult run(std::vector<std::string> arguments) const {
    return jalousie::test::runProgram(JALOUSIE_WAD_PROGRAM, arguments);
  }

  std::filesystem::path folder_;
};

TEST_F(WadProgram, WritesASceneAndAReport) {
  const auto result = run({path("house.wad"), "--map", "MAP01", "-o", path("a.glb"), "--json", "-"});
  EXPECT_EQ(result.exitCode, 0) << result.standardError;
  const auto report = nlohmann::json::parse(result.standardOutput);
  EXPECT_EQ(report["rooms"], 4);
  EXPECT_EQ(report["portals"], 6);
  EXPECT_EQ(report["sectors"], 4);
  EXPECT_EQ(run({path("house.wad"), "--map", "MAP01", "-o", path("b.glb"), "-q"}).standardOutput, "");
  EXPECT_EQ(readFile(path("a.glb"), 1U << 20U), readFile(path("b.glb"), 1U << 20U)) << "the same bytes";
  EXPECT_NE(run({path("house.wad"), "--map", "MAP01", "--doors", "closed", "-o", path("c.glb")})
                .standardOutput.find("3 rooms, 4 portals"),
            std::string::npos);
}

TEST_F(WadProgram, FailuresAreOneLineThatNamesTheFile) {
  writeFileAtomic(folder_ / "text.wad", "no level at all");
  const auto fails = [&](const std::vector<std::string>& arguments, int code, const char* part) {
    const auto result = run(arguments);
    EXPECT_EQ(result.exitCode, code) << result.standardError;
    EXPECT_TRUE(result.standardError.starts_with("jalousie-wad: ")) << result.standardError;
    EXPECT_EQ(std::count(result.standardError.begin(), result.standardError.end(), '\n'), 1);
    EXPECT_NE(result.standardError.find(part), std::string::npos) << result.standardError;
    EXPECT_FALSE(std::filesystem::exists(path("x.glb")));
  };
  fails({path("house.wad"), "--map", "E1M1", "-o", path("x.glb")}, 2, "house.wad: no level E1M1; --map may be: MAP01");
  fails({path("text.wad"), "--map", "E1M1", "-o", path("x.glb")}, 6, "text.wad: no WAD file");
  fails({path("none.wad"), "--map", "E1M1", "-o", path("x.glb")}, 3, "none.wad");
  fails({path("house.wad"), "-o", path("x.glb")}, 2, "--map");
  fails({path("house.wad"), "--map", "MAP01", "-o", path("house.wad")}, 2, "house.wad");
}

}  // namespace
}  // namespace jalousie::wad
