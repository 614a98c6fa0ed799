// Every file of the corpus gives the exit code and the reason it deserves: one line, nothing written, nothing opened
// outside its folder, little time and memory, no signal.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <thread>

#include "support/corpus.h"
#include "support/opened_files.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

class HostileCorpus : public test::CorpusTest {
 protected:
  static test::ProgramResult run(const std::vector<std::string>& arguments) {
    // Freed memory kept for later reports would count as ours.
    return test::runProgram(
        JALOUSIE_BAKE_PROGRAM, arguments,
        {.environment = {"ASAN_OPTIONS=quarantine_size_mb=16"}, .signalAfter = std::chrono::milliseconds(0)});
  }
  static std::vector<std::string> bake(const test::CorpusCase& file, const fs::path& output) {
    return {file.input.string(), "-o", output.string(), "-q", "--preset", "draft", "--levels", "2"};
  }
};

bool isBelow(const fs::path& file, const fs::path& folder) {
  return file.string().starts_with(folder.string() + "/");
}

/// Whether a program may open this whatever its input is: libraries, the state of the system, what it writes.
bool isHarmless(const fs::path& file, const fs::path& outputs) {
  const std::string name = file.string();
  const auto below = [&](const char* folder) { return name.starts_with(folder); };
  return below("/usr/lib") || below("/lib") || below("/proc/") || below("/sys/") || below("/dev/null") ||
         below(JALOUSIE_BINARY_DIR) || name == "/etc/ld.so.cache" || name == "/etc/ssl/openssl.cnf" ||
         name == outputs || file.parent_path() == outputs;
}

TEST_F(HostileCorpus, EveryFileGetsItsCodeAndReasonAndLeavesNothing) {
  const test::TemporaryFolder results;
  std::size_t broken = 0;
  std::map<int, int> codes;
  for (const test::CorpusCase& file : cases_) {
    SCOPED_TRACE(file.name);
    const test::ProgramResult result = run(bake(file, results / "out.glb"));
    expectVerdict(result, file, file.baker);
    EXPECT_EQ(fs::is_empty(results.path()), file.baker.code != 0);
    EXPECT_LT(result.cpuSeconds, 5.0);
    EXPECT_LT(result.peakBytes, 512ULL << 20U);
    fs::remove(results / "out.glb");
    broken += file.baker.code != 0 ? 1U : 0U;
    ++codes[file.baker.code];
  }
  EXPECT_GE(broken, 150U);
  for (const int code : {0, 3, 4, 5, 6, 7})
    EXPECT_GT(codes[code], 0) << code;
}

TEST_F(HostileCorpus, NothingOutsideItsFolderIsOpened) {
  const test::TemporaryFolder results;
  const fs::path outputs = fs::canonical(results.path());
  for (const test::CorpusCase& file : cases_) {
    SCOPED_TRACE(file.name);
    const std::optional<std::set<fs::path>> opened =
        test::filesOpenedBy(JALOUSIE_BAKE_PROGRAM, bake(file, results / "out.glb"));
    if (!opened) GTEST_SKIP() << "programs may not be traced here";
    const fs::path folder = fs::canonical(file.input.parent_path());
    // The input itself may be a link: what it leads to was asked for.
    std::error_code absent;
    const fs::path input = fs::weakly_canonical(file.input, absent);
    EXPECT_TRUE(file.baker.code != 0 || opened->contains(input)) << "the program was not traced";
    for (const fs::path& path : *opened)
      EXPECT_TRUE(isHarmless(path, outputs) || path == folder || isBelow(path, folder) || path == input) << path;
    fs::remove(results / "out.glb");
  }
}

TEST(OpenedFiles, AreThoseOfTheProgramAndOfNoOther) {
  const test::TemporaryFolder folder;
  for (const char* name : {"read", "from-a-child", "of-others"})
    std::ofstream(folder / name) << "content";
  fs::create_symlink("read", folder / "link");
  std::jthread other([&](const std::stop_token& stop) {
    while (!stop.stop_requested())
      std::ifstream(folder / "of-others").get();
  });
  const std::string script =
      "cat " + (folder / "link").string() + " && (cat " + (folder / "from-a-child").string() + ")";
  const std::optional<std::set<fs::path>> opened = test::filesOpenedBy("/bin/sh", {"-c", script});
  if (!opened) GTEST_SKIP() << "programs may not be traced here";
  const fs::path real = fs::canonical(folder.path());
  EXPECT_TRUE(opened->contains(real / "read")) << "through a link";
  EXPECT_TRUE(opened->contains(real / "from-a-child"));
  EXPECT_FALSE(opened->contains(real / "of-others"));
  EXPECT_FALSE(isHarmless(real / "read", "/tmp/elsewhere"));
  EXPECT_FALSE(isHarmless("/etc/passwd", "/tmp/elsewhere"));
}

TEST_F(HostileCorpus, InspectSurvivesEveryGltfFile) {
  for (const test::CorpusCase& file : cases_) {
    if (!file.isGltf()) continue;
    const int code = run({"inspect", file.input.string(), "-q"}).exitCode;
    EXPECT_TRUE(code == 0 || (code >= 3 && code <= 7)) << file.name << ": " << code;
    EXPECT_TRUE(file.baker.code != 0 || code == 0) << file.name << ": " << code;
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
  std::size_t warnings = 0;
  for (const nlohmann::json& file : report["files"])
    if (file.contains("warnings")) warnings += file["warnings"].size();
  EXPECT_EQ(linesOf(result.standardError), report["summary"]["failed"].get<std::size_t>() + warnings);
}

}  // namespace
}  // namespace jalousie
