// Every file of the corpus gives the exit code it deserves: one line, nothing written, nothing opened outside its
// folder, little time and memory, no signal.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "core/descriptor.h"
#include "support/node.h"
#include "support/run_program.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

/// Tells of every file that anybody opens in some folders.
class OpenWatch {
 public:
  OpenWatch() : inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}
  void add(const fs::path& path) const { ::inotify_add_watch(inotify_.get(), path.c_str(), IN_OPEN | IN_ACCESS); }
  bool sawSomething() const {
    char events[4096];
    return ::read(inotify_.get(), events, sizeof events) > 0;
  }

 private:
  Descriptor inotify_;
};

class HostileCorpus : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::optional<fs::path> node = test::findNode();
    if (!node) return;
    folder_ = new test::TemporaryFolder();
    const test::ProgramResult made = test::runProgram(
        *node, {(fs::path(JALOUSIE_SOURCE_DIR) / "tests/hostile/make_corpus.mjs").string(), folder_->path().string()});
    ASSERT_EQ(made.exitCode, 0) << made.standardError;
    cases_ = nlohmann::json::parse(std::ifstream(*folder_ / "index.json"));
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  void SetUp() override {
    if (folder_ == nullptr) GTEST_SKIP() << "Node.js is not installed; it makes the corpus";
  }

  static test::ProgramResult run(const std::vector<std::string>& arguments) {
    // Freed memory kept for later reports would count as ours.
    return test::runProgram(
        JALOUSIE_BAKE_PROGRAM, arguments,
        {.environment = {"ASAN_OPTIONS=quarantine_size_mb=16"}, .signalAfter = std::chrono::milliseconds(0)});
  }
  static std::size_t linesOf(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  static test::TemporaryFolder* folder_;
  static nlohmann::json cases_;
};

test::TemporaryFolder* HostileCorpus::folder_ = nullptr;
nlohmann::json HostileCorpus::cases_;

TEST_F(HostileCorpus, EveryFileGetsItsCodeAndLeavesNothing) {
  OpenWatch watch;
  watch.add(*folder_ / "outside");
  watch.add("/etc/passwd");
  const test::TemporaryFolder results;
  std::size_t broken = 0;
  std::map<int, int> codes;
  for (const nlohmann::json& entry : cases_) {
    const std::string name = entry["name"];
    const int code = entry["code"];
    SCOPED_TRACE(name);
    const test::ProgramResult result =
        run({(*folder_ / entry["input"].get<std::string>()).string(), "-o", (results / "out.glb").string(), "-q",
             "--preset", "draft", "--levels", "2"});
    EXPECT_EQ(result.exitCode, code) << result.standardError;
    EXPECT_EQ(linesOf(result.standardError), code == 0 ? 0U : 1U) << result.standardError;
    EXPECT_EQ(result.standardOutput, "");
    EXPECT_EQ(fs::is_empty(results.path()), code != 0);
    EXPECT_FALSE(watch.sawSomething()) << "something outside the folder was opened";
    EXPECT_LT(result.cpuSeconds, 5.0);
    EXPECT_LT(result.peakBytes, 512ULL << 20U);
    fs::remove(results / "out.glb");
    broken += code != 0 ? 1U : 0U;
    ++codes[code];
  }
  EXPECT_GE(broken, 150U);
  for (const int code : {0, 3, 4, 5, 6, 7})
    EXPECT_GT(codes[code], 0) << code;
}

TEST_F(HostileCorpus, InspectSurvivesEveryGltfFile) {
  for (const nlohmann::json& entry : cases_) {
    const fs::path input = *folder_ / entry["input"].get<std::string>();
    if (input.extension() != ".glb" && input.extension() != ".gltf") continue;
    const int code = run({"inspect", input.string(), "-q"}).exitCode;
    EXPECT_TRUE(code == 0 || (code >= 3 && code <= 7)) << entry["name"] << ": " << code;
    EXPECT_TRUE(entry["code"] != 0 || code == 0) << entry["name"] << ": " << code;
  }
}

TEST_F(HostileCorpus, ABatchOfEverythingBakesTheValidOnes) {
  const test::TemporaryFolder results;
  const test::ProgramResult result =
      run({folder_->path().string(), "-o", (results / "out/").string(), "-q", "--preset", "draft", "--levels", "2",
           "--keep-extension", "--json", (results / "report.json").string()});
  EXPECT_EQ(result.exitCode, 11);
  const nlohmann::json report = nlohmann::json::parse(std::ifstream(results / "report.json"));
  std::size_t baked = 0;
  for (const nlohmann::json& file : report["files"]) {
    const bool done = file["status"] == "baked";
    baked += done ? 1U : 0U;
    EXPECT_EQ(fs::exists(file["output"].get<std::string>()), done) << file["input"];
  }
  EXPECT_EQ(baked, report["summary"]["baked"].get<std::size_t>());
  EXPECT_GE(baked, 8U);
  EXPECT_EQ(linesOf(result.standardError), report["summary"]["failed"].get<std::size_t>());
}

}  // namespace
}  // namespace jalousie
