// SIGHUP, SIGINT and SIGTERM at random moments end every program alike and leave no part of a file.
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/random.h"
#include "programs/programs_fixture.h"

namespace jalousie {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using test::Command;
using test::ProgramResult;

#if defined(__SANITIZE_ADDRESS__)
constexpr int kTrials = 3;
#else
constexpr int kTrials = 8;
#endif
constexpr int kSignals[] = {SIGHUP, SIGINT, SIGTERM};

bool isJson(const std::string& text) {
  return nlohmann::json::accept(text);
}

class Signals : public test::ProgramsTest {
 protected:
  static std::set<std::string> names() {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_->path()))
      names.insert(entry.path().lexically_relative(folder_->path()).string());
    return names;
  }

  /// Sends each signal at random moments of a command that writes `file` and prints JSON. The file exists before and
  /// must stay or become what an undisturbed run writes.
  static void expectWhole(Command command, const std::string& file, int trials = kTrials) {
    command.arguments.emplace_back("--force");  // the file that exists is of no kind
    SCOPED_TRACE(command.text());
    const auto start = Clock::now();
    ASSERT_EQ(run(command).exitCode, 0);
    const double duration = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    const std::string fresh = test::readText(at(file));
    const std::string old = "what was there before";
    const std::set<std::string> before = names();
    Random random(5);
    int interrupted = 0;
    for (int trial = 0; trial < trials; ++trial) {
      for (const int signal : kSignals) {
        std::ofstream(at(file)) << old;
        const milliseconds after(1 + static_cast<int>(duration * random.uniform()));
        const ProgramResult result = run(command, {.signalAfter = after, .signal = signal});
        EXPECT_TRUE(result.exitCode == 128 + signal || result.exitCode == 0) << result.exitCode;
        interrupted += result.exitCode != 0 ? 1 : 0;
        EXPECT_LE(test::linesOf(result.standardError), 1) << result.standardError;
        const std::string now = test::readText(at(file));
        EXPECT_TRUE(now == fresh || (now == old && result.exitCode != 0)) << now.size() << " bytes";
        EXPECT_TRUE(isJson(result.standardOutput) || (result.standardOutput.empty() && result.exitCode != 0));
        EXPECT_EQ(names(), before);
      }
    }
    EXPECT_GT(interrupted, 0) << "no signal came in time";
  }
};

TEST_F(Signals, Scatter) {
  expectWhole({JALOUSIE_SCATTER_PROGRAM, {"ball.glb", "--count", "200000", "-o", "many.glb", "-q", "--json", "-"}},
              "many.glb");
}

TEST_F(Signals, Bake) {
  expectWhole({JALOUSIE_BAKE_PROGRAM, {"ball.ply", "-o", "baked.glb", "--preset", "fast", "-q", "--json", "-"}},
              "baked.glb");
}

TEST_F(Signals, Inspect) {
  expectWhole({JALOUSIE_BAKE_PROGRAM, {"inspect", "ball.glb", "--sheet", "sheet.html", "--json"}}, "sheet.html",
              2);  // takes seconds
}

TEST_F(Signals, Record) {
  const auto start = Clock::now();
  const Command command = {JALOUSIE_PROGRAM, {"record", "scene.glb", "-o", "path.glb", "--frames", "300000", "-q"}};
  ASSERT_EQ(run(command).exitCode, 0);
  const double duration = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  const std::string whole = test::readText(at("path.glb"));
  Random random(6);
  for (int trial = 0; trial < 3 * kTrials; ++trial) {
    std::filesystem::remove(at("path.glb"));
    const std::set<std::string> before = names();
    const int signal = kSignals[trial % 3];
    const milliseconds after(1 + static_cast<int>(duration * random.uniform()));
    const ProgramResult result = run(command, {.signalAfter = after, .signal = signal});
    EXPECT_TRUE(result.exitCode == 128 + signal || result.exitCode == 0) << result.exitCode;
    if (exists("path.glb")) {
      EXPECT_EQ(test::readText(at("path.glb")), whole);
    } else {
      EXPECT_EQ(names(), before);
    }
  }
}

TEST_F(Signals, RenderAndDiff) {
  if (!hasGl_) GTEST_SKIP() << "no OpenGL 4.5";
  expectWhole({JALOUSIE_PROGRAM,
               {"render", "scene.glb", "-o", "signal.png", "--size", "64x36", "--repeat", "20", "-q", "--json", "-"}},
              "signal.png");
  ASSERT_EQ(run({JALOUSIE_PROGRAM, {"render", "scene.glb", "-o", "large.png", "--size", "640x360", "-q"}}).exitCode, 0);
  expectWhole({JALOUSIE_PROGRAM, {"diff", "large.png", "large.png", "-o", "map.png", "--json", "-"}}, "map.png");
}

TEST_F(Signals, CompareKeepsWhatWasMeasured) {
  if (!hasGl_) GTEST_SKIP() << "no OpenGL 4.5";
  for (const int signal : kSignals) {
    std::filesystem::remove_all(at("report"));
    std::vector<std::string> words = {"compare", "scene.glb", "-o",     "report", "--frames", "0:1799",
                                      "--size",  "64x36",     "--keep", "0",      "-q"};
    test::RunningProgram running(JALOUSIE_PROGRAM, words, {.folder = folder_->path()});
    for (int i = 0; i < 1200 && test::linesOf(test::readText(at("report/run.jsonl"))) < 4; ++i)
      std::this_thread::sleep_for(milliseconds(50));
    running.signal(signal);
    const ProgramResult result = running.wait();
    EXPECT_EQ(result.exitCode, 128 + signal);
    EXPECT_EQ(test::linesOf(result.standardError), 1) << result.standardError;
    EXPECT_NE(result.standardError.find("--resume continues"), std::string::npos) << result.standardError;
    const auto summary = nlohmann::json::parse(test::readText(at("report/summary.json")));
    EXPECT_EQ(summary["complete"], false);
  }
}

TEST_F(Signals, IgnoredOnesStayIgnored) {
  for (const int signal : kSignals) {
    const test::ProgramSetup setup = {.signalAfter = milliseconds(5), .signal = signal, .ignoredSignal = signal};
    EXPECT_EQ(run({JALOUSIE_SCATTER_PROGRAM, {"ball.glb", "--count", "200000", "-o", "n.glb", "-q"}}, setup).exitCode,
              0);
    EXPECT_EQ(run({JALOUSIE_BAKE_PROGRAM, {"ball.ply", "-o", "n.glb", "--preset", "fast", "-q"}}, setup).exitCode, 0);
    EXPECT_EQ(run({JALOUSIE_PROGRAM, {"record", "scene.glb", "-o", "path.glb", "-q"}}, setup).exitCode, 0);
  }
}

TEST_F(Signals, CloseTheViewerWhichKeepsItsSettings) {
  if (!hasGl_ || std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no display";
  const std::string home = at("config").string();
  for (const int signal : kSignals) {
    std::filesystem::remove_all(home);
    test::RunningProgram viewer(JALOUSIE_PROGRAM, {"view", "scene.glb", "--json", "viewed.json"},
                                {.environment = {"XDG_CONFIG_HOME=" + home}, .folder = folder_->path()});
    std::this_thread::sleep_for(std::chrono::seconds(3));
    viewer.signal(signal);
    const ProgramResult result = viewer.wait();
    EXPECT_EQ(result.exitCode, 128 + signal) << result.standardError;
    EXPECT_TRUE(std::filesystem::exists(home + "/jalousie/view.json"));
    EXPECT_TRUE(isJson(test::readText(at("viewed.json"))));
  }
  // A script is not finished, so that it writes nothing.
  const ProgramResult script =
      run({JALOUSIE_PROGRAM, {"view", "scene.glb", "--screenshot", "viewed.png", "--frames", "1000000"}},
          {.signalAfter = std::chrono::seconds(3), .signal = SIGTERM});
  EXPECT_EQ(script.exitCode, 143);
  EXPECT_EQ(script.standardError, "jalousie: interrupted\n");
  EXPECT_FALSE(exists("viewed.png"));
}

}  // namespace
}  // namespace jalousie
