// Batches that are killed or asked to end at random moments.
#include <signal.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "core/random.h"
#include "hostile/batch_fixture.h"

namespace jalousie {
namespace {

using test::ProgramResult;
using Clock = std::chrono::steady_clock;

#if defined(__SANITIZE_ADDRESS__)
constexpr int kKills = 20;  // each start takes several times as long
#else
constexpr int kKills = 100;
#endif

class Interruption : public test::BatchFixture {
 protected:
  std::vector<std::string> arguments(const std::string& out, const std::string& levels = "6") const {
    return {at("in"), "-o", at(out) + "/", "--preset", "draft", "--levels", levels, "-j", "2", "-q"};
  }
  ProgramResult bake(const std::string& out, test::ProgramSetup setup = {}, const std::string& levels = "6") const {
    // A leak checker whose process is killed meanwhile says so on standard error.
    setup.environment.emplace_back("ASAN_OPTIONS=detect_leaks=0");
    return test::runProgram(JALOUSIE_BAKE_PROGRAM, arguments(out, levels), setup);
  }
  /// A reference run and how long it takes.
  std::chrono::microseconds reference(const std::string& out, const std::string& levels = "6") const {
    const auto start = Clock::now();
    EXPECT_EQ(bake(out, {}, levels).exitCode, 0);
    return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - start);
  }
};

TEST_F(Interruption, KillsLeaveWholeFilesAndARerunFinishes) {
  const auto duration = reference("whole");
  const auto whole = contents("whole");
  ASSERT_EQ(whole.size(), 7U);
  Random random(7);
  int survivors = 0;
  int interrupted = 0;
  for (int kill = 0; kill < kKills; ++kill) {
    SCOPED_TRACE(kill);
    std::filesystem::remove_all(folder_ / "out");
    const auto after = std::chrono::duration_cast<std::chrono::milliseconds>(duration * random.uniform());
    const int signal = std::array{SIGTERM, SIGINT, SIGHUP, SIGKILL}[static_cast<std::size_t>(kill) % 4];
    const ProgramResult result =
        bake("out", {.signalAfter = std::max(after, std::chrono::milliseconds(1)), .signal = signal});
    for (const auto& [name, bytes] : contents("out")) {
      ASSERT_TRUE(whole.contains(name)) << name;
      EXPECT_EQ(bytes, whole.at(name)) << name;
    }
    const bool finished = contents("out").size() == whole.size();
    survivors += finished ? 1 : 0;
    // A signal before the program listens ends it the plain way, which says nothing and looks like the same code.
    const bool said = result.exitCode == 128 + signal && !result.standardError.empty();
    interrupted += said ? 1 : 0;
    EXPECT_EQ(std::count(result.standardError.begin(), result.standardError.end(), '\n'), said ? 1 : 0)
        << result.standardError;
    EXPECT_TRUE(said || finished || result.exitCode == 128 + signal) << result.exitCode;
    if (kill % 10 != 9) continue;
    EXPECT_EQ(bake("out").exitCode, 0);
    EXPECT_EQ(contents("out"), whole);
  }
  EXPECT_LT(survivors, kKills) << "no kill came in time";
  EXPECT_GT(interrupted, 0);
}

TEST_F(Interruption, KillsWhileReplacingLeaveOldOrNewFiles) {
  reference("old", "3");
  const auto duration = reference("new");
  const auto old = contents("old");
  const auto fresh = contents("new");
  Random random(11);
  for (int kill = 0; kill < kKills / 4; ++kill) {
    SCOPED_TRACE(kill);
    std::filesystem::remove_all(folder_ / "out");
    std::filesystem::copy(folder_ / "old", folder_ / "out");
    const auto after = std::chrono::duration_cast<std::chrono::milliseconds>(duration * random.uniform());
    bake("out", {.signalAfter = std::max(after, std::chrono::milliseconds(1)), .signal = SIGKILL});
    for (const auto& [name, bytes] : contents("out")) {
      if (name.starts_with(".jalousie-")) continue;  // complete, and killed just before it was renamed
      EXPECT_TRUE(bytes == old.at(name) || bytes == fresh.at(name)) << name;
    }
    EXPECT_EQ(bake("out").exitCode, 0);
    EXPECT_EQ(contents("out"), fresh) << "and nothing that was left over";
  }
}

TEST_F(Interruption, KillsDoNotHarmACache) {
  const auto duration = reference("whole");
  const auto whole = contents("whole");
  std::vector<std::string> cached = arguments("out");
  cached.insert(cached.end(), {"--cache", at("cache")});
  Random random(13);
  for (int kill = 0; kill < kKills / 5; ++kill) {
    const auto after = std::chrono::duration_cast<std::chrono::milliseconds>(duration * random.uniform());
    test::runProgram(JALOUSIE_BAKE_PROGRAM, cached,
                     {.signalAfter = std::max(after, std::chrono::milliseconds(1)), .signal = SIGKILL});
    std::filesystem::remove_all(folder_ / "out");
  }
  EXPECT_EQ(test::runProgram(JALOUSIE_BAKE_PROGRAM, cached).exitCode, 0);
  EXPECT_EQ(contents("out"), whole);
}

}  // namespace
}  // namespace jalousie
