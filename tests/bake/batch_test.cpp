// jalousie-bake over many files: one bad file, caches, depfiles, limits, reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "asset/gltf_file.h"
#include "bake/bake_fixtures.h"
#include "bake/pipeline/batch.h"
#include "bake/pipeline/command_line.h"
#include "bake/pipeline/progress_log.h"
#include "core/file.h"
#include "support/run_program.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;

class BakeBatch : public testing::Test {
 protected:
  BakeBatch() {
    fs::create_directories(folder_ / "in/sub");
    write("in/ball.ply", test::spherePly(16, 8));
    write("in/sub/egg.ply", test::spherePly(12, 8));
    write("in/quad.obj", "mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n");
    write("in/quad.mtl", "newmtl red\nKd 1 0 0\n");
    write("in/split.gltf", splitDocument());
    write("in/split.bin", std::string(36, '\0')
                              .replace(12, 4, std::string("\0\0\x80\x3F", 4))
                              .replace(28, 4, std::string("\0\0\x80\x3F", 4)));
  }
  static std::string splitDocument() {
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "meshes":[{"name":"split","primitives":[{"attributes":{"POSITION":0}}]}],
      "buffers":[{"byteLength":36,"uri":"split.bin"}],"bufferViews":[{"buffer":0,"byteLength":36}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})";
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::byte> bytes(const std::string& name) const { return readFile(folder_ / name, 1U << 30U); }

  /// Runs in the folder of the test, with the draft preset.
  ProgramResult bake(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--preset", "draft"});
    return test::runProgram(JALOUSIE_BAKE_PROGRAM, arguments, {.folder = folder_.path()});
  }
  json report(std::vector<std::string> arguments, int exitCode = 0) const {
    arguments.insert(arguments.end(), {"--json", "-"});
    const ProgramResult result = bake(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.standardError;
    return json::parse(result.standardOutput);
  }
  /// input -> status
  static std::map<std::string, std::string> statuses(const json& report) {
    std::map<std::string, std::string> result;
    for (const json& file : report["files"])
      result[file["input"].get<std::string>()] = file["status"];
    return result;
  }
  static std::size_t linesOf(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  const test::TemporaryFolder folder_;
};

TEST_F(BakeBatch, AFolderBecomesAFolder) {
  const ProgramResult result = bake({"in", "-o", "out/"});
  ASSERT_EQ(result.exitCode, 0) << result.standardError;
  for (const char* name : {"out/ball.glb", "out/sub/egg.glb", "out/quad.glb", "out/split.glb"})
    EXPECT_FALSE(asset::loadGltf(folder_ / name).meshes.empty()) << name;
  EXPECT_EQ(result.standardOutput, "4 files: 4 baked\n");
  EXPECT_EQ(linesOf(result.standardError), 4U) << "a log gets a line for each file";
  EXPECT_EQ(bake({"in", "-o", "out", "-q"}).standardError, "");
}

TEST_F(BakeBatch, OneBadFileFailsAlone) {
  write("in/bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  write("in/worse.glb", "glTF");
  const json baked = report({"in", "in/missing.ply", "-o", "out/", "--sheet", "sheets/"}, 11);
  EXPECT_EQ(baked["summary"]["baked"], 4);
  EXPECT_EQ(baked["summary"]["failed"], 3);
  EXPECT_EQ(statuses(baked).at("in/bad.obj"), "failed");
  for (const auto& file : baked["files"]) {
    const std::string output = file["output"];
    EXPECT_EQ(fs::exists(folder_ / output), file["status"] == "baked") << output;
    if (file["input"] == "in/missing.ply") {
      EXPECT_EQ(file["error"]["code"], 3);
      EXPECT_EQ(file["error"]["name"], "file-not-found");
    }
  }
  EXPECT_TRUE(fs::exists(folder_ / "sheets/sub/egg.html"));
  const ProgramResult quiet = bake({"in", "-o", "out/", "-q"});
  EXPECT_EQ(quiet.exitCode, 11);
  EXPECT_EQ(linesOf(quiet.standardError), 2U) << quiet.standardError;
}

TEST_F(BakeBatch, ReportHoldsTheMeshesOfEveryFile) {
  const json baked = report({"in/ball.ply", "in/quad.obj", "-o", "out/"});
  ASSERT_EQ(baked["files"].size(), 2U);
  EXPECT_GE(baked["files"][0]["meshes"][0]["levels"].size(), 3U);
  EXPECT_EQ(baked["files"][1]["meshes"][0]["name"], "quad");
  EXPECT_EQ(baked["interrupted"], false);
}

TEST_F(BakeBatch, UnchangedWorkIsSkipped) {
  const std::vector<std::string> run = {"in", "-o", "out/", "--cache", "cache"};
  EXPECT_EQ(report(run)["summary"]["baked"], 4);
  const auto before = bytes("out/ball.glb");
  EXPECT_EQ(report(run)["summary"]["unchanged"], 4);
  fs::remove_all(folder_ / "out");
  EXPECT_EQ(report(run)["summary"]["cached"], 4);
  EXPECT_EQ(bytes("out/ball.glb"), before);
  EXPECT_GE(report(run)["files"][0]["meshes"][0]["levels"].size(), 3U) << "the report is kept too";
}

TEST_F(BakeBatch, WhateverDecidesTheBytesDecidesTheHit) {
  const std::vector<std::string> run = {"in", "-o", "out/", "--cache", "cache"};
  const auto baked = [&](std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = run;
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<std::string> names;
    for (const auto& [name, status] : statuses(report(arguments)))
      if (status == "baked") names.push_back(name);
    return names;
  };
  using Names = std::vector<std::string>;
  ASSERT_EQ(baked().size(), 4U);
  EXPECT_EQ(baked(), Names{});
  EXPECT_EQ(baked({"-j", "1", "--max-memory", "0", "-q"}), Names{}) << "how the work is done decides nothing";
  EXPECT_EQ(baked({"--levels", "3"}).size(), 4U);
  EXPECT_EQ(baked({"--levels", "3"}), Names{});
  EXPECT_EQ(baked({"--cells", "64"}).size(), 4U);
  EXPECT_EQ(baked({"--cells", "off"}).size(), 4U);
  EXPECT_EQ(baked({"--cells", "64"}), Names{});
  write("in/quad.mtl", "newmtl red\nKd 0 1 0\n");
  EXPECT_EQ(baked(), Names{"in/quad.obj"}) << "a side file changed";
  std::string other(36, '\0');
  other[30] = other[14] = '\x40';
  write("in/split.bin", other);
  EXPECT_EQ(baked(), Names{"in/split.gltf"});
  write("in/quad.mtl", "newmtl red\nKd 1 0 0\n");
  EXPECT_EQ(baked(), Names{}) << "and back: both variants are kept";
  fs::remove(folder_ / "in/quad.mtl");
  EXPECT_EQ(baked(), Names{"in/quad.obj"}) << "a side file that is gone";
  EXPECT_EQ(baked(), Names{});
  fs::rename(folder_ / "in/ball.ply", folder_ / "in/sphere.ply");
  EXPECT_EQ(baked(), Names{"in/sphere.ply"}) << "the name of a mesh follows from the file's";
  fs::rename(folder_ / "in/split.gltf", folder_ / "in/joined.gltf");
  EXPECT_EQ(baked(), Names{}) << "that of glTF does not";
}

TEST_F(BakeBatch, DamagedCachesAreMisses) {
  const std::vector<std::string> run = {"in", "-o", "out/", "--cache", "cache"};
  ASSERT_EQ(report(run)["summary"]["baked"], 4);
  const auto before = bytes("out/ball.glb");
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache"))
    if (entry.is_regular_file()) std::ofstream(entry.path(), std::ios::in | std::ios::out).put('#');
  EXPECT_EQ(report(run)["summary"]["baked"], 4);
  EXPECT_EQ(bytes("out/ball.glb"), before);
  write("cache-file", "not a folder");
  const ProgramResult result = bake({"in/ball.ply", "-o", "one.glb", "--cache", "cache-file", "-q"});
  EXPECT_EQ(result.exitCode, 0) << "a cache that cannot be used costs time, not the result";
  EXPECT_EQ(linesOf(result.standardError), 1U) << result.standardError;
}

TEST_F(BakeBatch, CachesStayBelowTheirLimit) {
  ASSERT_EQ(bake({"in", "-o", "out/", "--cache", "cache", "--cache-limit", "4k"}).exitCode, 0);
  std::uintmax_t size = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache"))
    if (entry.is_regular_file()) size += entry.file_size();
  EXPECT_LE(size, 4096U);
  EXPECT_EQ(bake({"in", "-o", "out/", "--cache-limit", "4k"}).exitCode, 2);
}

TEST_F(BakeBatch, DepfileNamesEverythingThatWasRead) {
  ASSERT_EQ(bake({"in/quad.obj", "in/split.gltf", "in/ball.ply", "-o", "out/", "--depfile", "all.d"}).exitCode, 0);
  const auto text = bytes("all.d");
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(text.data()), text.size()),
            "out/quad.glb: \\\n  in/quad.obj \\\n  in/quad.mtl\nout/split.glb: \\\n  in/split.gltf \\\n  in/split.bin\n"
            "out/ball.glb: \\\n  in/ball.ply\n");
  ASSERT_EQ(bake({"in/split.gltf", "-o", "s.glb", "--depfile", "s.d", "--cache", "cache"}).exitCode, 0);
  const auto baked = bytes("s.d");
  ASSERT_EQ(bake({"in/split.gltf", "-o", "s.glb", "--depfile", "s.d", "--cache", "cache"}).exitCode, 0);
  EXPECT_EQ(bytes("s.d"), baked) << "from the cache too";
}

TEST_F(BakeBatch, UnchangedOutputsGetTheTimeOfTheRun) {
  ASSERT_EQ(bake({"in/ball.ply", "-o", "b.glb", "--cache", "cache"}).exitCode, 0);
  fs::last_write_time(folder_ / "b.glb", fs::file_time_type::clock::now() - std::chrono::hours(1));
  fs::last_write_time(folder_ / "in/ball.ply", fs::file_time_type::clock::now());
  ASSERT_EQ(bake({"in/ball.ply", "-o", "b.glb", "--cache", "cache"}).exitCode, 0);
  EXPECT_GE(fs::last_write_time(folder_ / "b.glb"), fs::last_write_time(folder_ / "in/ball.ply"))
      << "else Make would bake for ever";
}

TEST_F(BakeBatch, ListsAndPatternsAreInputs) {
  write("list", "in/ball.ply\nin/quad.obj\n");
  EXPECT_EQ(report({"--files-from", "list", "-o", "out/"})["summary"]["baked"], 2);
  EXPECT_TRUE(fs::exists(folder_ / "out/in/ball.glb"));
  EXPECT_EQ(report({"in/**/*.ply", "-o", "out/"})["summary"]["baked"], 2);
  EXPECT_EQ(bake({"--files-from", "nowhere", "-o", "out/"}).exitCode, 3);
  EXPECT_EQ(bake({"in/*.xyz", "-o", "out/"}).exitCode, 3);
  EXPECT_EQ(bake({"-o", "out/"}).exitCode, 2);
}

TEST_F(BakeBatch, MistakesAreNamedBeforeAnythingIsBaked) {
  write("in/ball.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramResult collision = bake({"in", "-o", "out/"});
  EXPECT_EQ(collision.exitCode, 2);
  EXPECT_NE(collision.standardError.find("--keep-extension"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(bake({"in", "-o", "out/", "--keep-extension"}).exitCode, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/ball.obj.glb"));
  EXPECT_EQ(bake({"in", "-o", "one.glb"}).exitCode, 2) << "a folder cannot become a file";
  EXPECT_EQ(bake({"in/ball.ply", "-o", "one.glb", "--keep-extension"}).exitCode, 2);
}

TEST_F(BakeBatch, BakingBesideTheInputsDoesNotFeedOnItself) {
  ASSERT_EQ(bake({"in", "-o", "in/baked/"}).exitCode, 0);
  EXPECT_EQ(report({"in", "-o", "in/baked/"})["files"].size(), 4U);
}

TEST_F(BakeBatch, MaterialsThatCannotBeReadAreNoHits) {
  fs::remove(folder_ / "in/quad.mtl");
  fs::create_directory(folder_ / "in/quad.mtl");
  const std::vector<std::string> run = {"in/quad.obj", "-o", "q.glb", "--cache", "cache", "-q"};
  ASSERT_EQ(bake(run).exitCode, 0);
  const auto without = bytes("q.glb");
  fs::remove(folder_ / "in/quad.mtl");
  write("in/quad.mtl", "newmtl red\nKd 1 0 0\n");
  ASSERT_EQ(bake(run).exitCode, 0);
  EXPECT_NE(bytes("q.glb"), without);
}

TEST_F(BakeBatch, MaterialBombsAreLimits) {
  std::string materials;
  for (int i = 0; i < 20'000; ++i)
    materials += "newmtl a\n";
  write("in/quad.mtl", materials);
  EXPECT_EQ(bake({"in/quad.obj", "-o", "q.glb", "-q"}).exitCode, 7);
}

TEST_F(BakeBatch, NobodyNeedsToListen) {
  const auto shell = [&](const std::string& redirect, const std::string& options) {
    return test::runProgram(
               "/bin/sh",
               {"-c", "exec \"$0\" in/ball.ply in/missing.ply -o out/ --preset draft " + options + redirect,
                JALOUSIE_BAKE_PROGRAM},
               {.folder = folder_.path()})
        .exitCode;
  };
  EXPECT_EQ(shell(" 2>&-", ""), 11);
  EXPECT_EQ(shell(" 2>/dev/full", ""), 11);
  EXPECT_EQ(shell(" 0<&- 1>&- 2>&-", "-q"), 11);
  EXPECT_EQ(shell(" >/dev/full", "--json -"), 8) << "a report that is lost is no success";
  EXPECT_TRUE(fs::exists(folder_ / "out/ball.glb"));
}

TEST_F(BakeBatch, IgnoredSignalsStayIgnored) {
  write("in/large.ply", test::spherePly(100, 60));
  const ProgramResult result = test::runProgram(
      "/bin/sh", {"-c", "trap '' HUP; exec \"$0\" in/large.ply -o out/ -q --preset fast", JALOUSIE_BAKE_PROGRAM},
      {.folder = folder_.path(), .signalAfter = std::chrono::milliseconds(60), .signal = 1});
  EXPECT_EQ(result.exitCode, 0) << "nohup";
}

TEST_F(BakeBatch, NamesMayBeAnyBytes) {
  write("in/caf\xE9.ply", test::spherePly(8, 5));
  write("in/quad.mtl", "newmtl gr\xF6n\nKd 1 0 0\n");
  write("in/quad.obj", "mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl gr\xF6n\nf 1 2 3\n");
  write("in/two\nlines.ply", test::spherePly(8, 5));
  const ProgramResult result = bake({"in", "-o", "out/", "--cache", "cache", "--depfile", "d", "--json", "r.json"});
  EXPECT_EQ(result.exitCode, 0) << result.standardError;
  EXPECT_TRUE(fs::exists(folder_ / "out/caf\xE9.glb"));
  EXPECT_EQ(linesOf(result.standardError), 7U) << "a line for each file and a warning: " << result.standardError;
}

TEST_F(BakeBatch, SlowFilesAreGivenUp) {
  write("in/large.ply", test::spherePly(900, 450));
  const ProgramResult result = test::runProgram(
      JALOUSIE_BAKE_PROGRAM,
      {at("in/large.ply"), at("in/quad.obj"), "-o", at("out/"), "--timeout", "0.5", "--preset", "best", "-q"});
  EXPECT_EQ(result.exitCode, 11);
  EXPECT_NE(result.standardError.find("--timeout"), std::string::npos) << result.standardError;
  EXPECT_TRUE(fs::exists(folder_ / "out/quad.glb"));
  EXPECT_FALSE(fs::exists(folder_ / "out/large.glb"));
}

TEST(ProgressLog, ShowsALongBakeEveryTenSecondsAndNoShortOne) {
  const bake::ProgressLog::Time start{};
  bake::ProgressLog log(start);
  const auto lineAt = [&](int milliseconds) {
    return log.lineAt(start + std::chrono::milliseconds(milliseconds), "level 2 of 10");
  };
  EXPECT_FALSE(lineAt(0).has_value());
  EXPECT_FALSE(lineAt(9999).has_value());
  EXPECT_EQ(lineAt(10000), "baking for 10 s: level 2 of 10");
  EXPECT_FALSE(lineAt(19999).has_value());
  EXPECT_EQ(lineAt(95000), "baking for 1 min 35 s: level 2 of 10");  // one line, however long nobody asked
  EXPECT_FALSE(lineAt(99999).has_value());
  EXPECT_EQ(log.lineAt(start + std::chrono::seconds(100), ""), "baking for 1 min 40 s");
}

TEST(BakeLimits, DefaultsGrowWithTheInputAndStayWithinTheMachine) {
  using bake::defaultMemory;
  using bake::defaultTimeout;
  using std::chrono::seconds;
  EXPECT_EQ(defaultTimeout(1), seconds(600));
  EXPECT_EQ(defaultTimeout(100ULL << 20U), seconds(6600));
  EXPECT_LE(defaultTimeout(~0ULL), seconds(1'000'000));
  EXPECT_EQ(defaultMemory(1 << 20U, 1ULL << 40U), (4ULL << 30U) + (64ULL << 20U));
  EXPECT_EQ(defaultMemory(1 << 20U, 1ULL << 30U), 1ULL << 30U);
  EXPECT_EQ(defaultMemory(~0ULL, 8ULL << 30U), 8ULL << 30U);
}

TEST(BakeLimits, ZeroLiftsALimitAndNothingLeavesTheDefault) {
  const auto parsed = [](const std::vector<const char*>& options) {
    std::vector<const char*> arguments = {"jalousie-bake", "a.ply", "-o", "a.glb"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return bake::parseCommandLine(static_cast<int>(arguments.size()), arguments.data()).value();
  };
  EXPECT_EQ(parsed({}).timeout, std::nullopt);
  EXPECT_EQ(parsed({}).maxMemory, std::nullopt);
  EXPECT_EQ(parsed({"--timeout", "0"}).timeout, std::chrono::milliseconds(0));
  EXPECT_EQ(parsed({"--timeout", "0.0001"}).timeout, std::chrono::milliseconds(1)) << "no limit only for 0 itself";
  EXPECT_EQ(parsed({"--max-memory", "0"}).maxMemory, 0U);
}

TEST_F(BakeBatch, MemoryIsLimited) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer's own memory cannot be limited";
#endif
  write("in/large.ply", test::spherePly(900, 450));
  const ProgramResult result =
      bake({"in/large.ply", "in/ball.ply", "-o", "out/", "--max-memory", "100M", "-j", "1", "-q"});
  EXPECT_EQ(result.exitCode, 11);
  EXPECT_NE(result.standardError.find("--max-memory"), std::string::npos) << result.standardError;
  EXPECT_TRUE(fs::exists(folder_ / "out/ball.glb"));
  EXPECT_EQ(bake({"in/large.ply", "-o", "l.glb", "--max-memory", "100M", "-q"}).exitCode, 7);
}

}  // namespace
}  // namespace jalousie
