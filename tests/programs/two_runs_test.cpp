// Two runs with one output: folders and files that two processes write at a time.
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "programs/programs_fixture.h"

namespace jalousie {
namespace {

using test::Command;
using test::ProgramResult;
using test::RunningProgram;

class TwoRuns : public test::ProgramsTest {
 protected:
  static std::vector<std::string> comparison(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"compare", "scene.glb", "-o",     "shared", "--frames", "0:440:40",
                                      "--size",  "64x36",     "--keep", "1",      "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// Waits until the log of the comparison holds steps; false if that does not happen.
  static bool waitForSteps(long steps) {
    for (int i = 0; i < 1200; ++i) {
      if (test::linesOf(test::readText(at("shared/run.jsonl"))) > steps) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  static void expectNoPartsIn(const std::string& folder) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(at(folder)))
      EXPECT_FALSE(entry.path().filename().string().starts_with(".jalousie-")) << entry.path();
  }
};

TEST_F(TwoRuns, AComparisonRefusesAFolderInUseAndResumesAfterAKill) {
  if (!hasGl_) GTEST_SKIP() << "no OpenGL 4.5";
  RunningProgram first(JALOUSIE_PROGRAM, comparison(), {.folder = folder_->path()});
  ASSERT_TRUE(waitForSteps(2));
  first.signal(SIGSTOP);
  const std::string log = test::readText(at("shared/run.jsonl"));
  for (const char* option : {"--resume", "--debug"}) {  // with --resume and without
    const ProgramResult second = run({JALOUSIE_PROGRAM, comparison({option})});
    EXPECT_EQ(second.exitCode, 8);
    EXPECT_EQ(second.standardError,
              "jalousie: shared: another run is using this folder; wait for it or choose another folder\n");
  }
  EXPECT_EQ(test::readText(at("shared/run.jsonl")), log) << "the first run's log is untouched";
  first.signal(SIGKILL);
  first.wait();
  const ProgramResult resumed = run({JALOUSIE_PROGRAM, comparison({"--resume"})});
  ASSERT_EQ(resumed.exitCode, 0) << resumed.standardError;
  const auto summary = nlohmann::json::parse(test::readText(at("shared/summary.json")));
  EXPECT_EQ(summary["complete"], true);
  EXPECT_EQ(summary["frames"]["count"], 12);
  EXPECT_TRUE(test::readText(at("shared/run.jsonl")).starts_with(log)) << "finished steps are kept";
  expectNoPartsIn("shared");
}

TEST_F(TwoRuns, TwoBatchesIntoOneFolderAndCacheBothEndWithTheSameFiles) {
  std::filesystem::create_directory(at("meshes"));
  for (unsigned i = 0; i < 5; ++i)
    std::ofstream(at("meshes/m" + std::to_string(i) + ".ply")) << test::spherePly(16 + 4 * i, 8 + i);
  const auto batch = [](const std::string& out, const std::string& cache) {
    return std::vector<std::string>{"meshes", "-o", out + "/", "--preset", "draft", "--cache", cache, "-q"};
  };
  ASSERT_EQ(run({JALOUSIE_BAKE_PROGRAM, batch("alone", "cache-alone")}).exitCode, 0);
  for (int round = 0; round < 5; ++round) {
    RunningProgram first(JALOUSIE_BAKE_PROGRAM, batch("both", "cache"), {.folder = folder_->path()});
    EXPECT_EQ(run({JALOUSIE_BAKE_PROGRAM, batch("both", "cache")}).exitCode, 0);
    EXPECT_EQ(first.wait().exitCode, 0);
    for (unsigned i = 0; i < 5; ++i) {
      const std::string name = "/m" + std::to_string(i) + ".glb";
      EXPECT_EQ(test::readText(at("both" + name)), test::readText(at("alone" + name)));
    }
    expectNoPartsIn("both");
    expectNoPartsIn("cache");
    if (round % 2 == 0) std::filesystem::remove_all(at("cache"));
  }
}

TEST_F(TwoRuns, TheLastOfTwoFramesIntoOneFileWins) {
  if (!hasGl_) GTEST_SKIP() << "no OpenGL 4.5";
  const auto frame = [](const std::string& out, const std::string& eye) {
    return std::vector<std::string>{"render", "ball.glb", "-o",     out,     "--size", "64x36",
                                    "--eye",  eye,        "--look", "0,0,0", "-q"};
  };
  std::filesystem::create_directory(at("frames"));
  ASSERT_EQ(run({JALOUSIE_PROGRAM, frame("frames/a.png", "0,0,3")}).exitCode, 0);
  ASSERT_EQ(run({JALOUSIE_PROGRAM, frame("frames/b.png", "0,0,6")}).exitCode, 0);
  const std::string a = test::readText(at("frames/a.png"));
  const std::string b = test::readText(at("frames/b.png"));
  ASSERT_NE(a, b);
  RunningProgram first(JALOUSIE_PROGRAM, frame("frames/same.png", "0,0,3"), {.folder = folder_->path()});
  EXPECT_EQ(run({JALOUSIE_PROGRAM, frame("frames/same.png", "0,0,6")}).exitCode, 0);
  EXPECT_EQ(first.wait().exitCode, 0);
  const std::string same = test::readText(at("frames/same.png"));
  EXPECT_TRUE(same == a || same == b);
  expectNoPartsIn("frames");
}

}  // namespace
}  // namespace jalousie
