// Every file of the corpus gives the exit code and the reason it deserves: one line, nothing written, little time and
// memory, no signal.
#include <gtest/gtest.h>

#include <map>

#include "support/corpus.h"

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
};

TEST_F(HostileCorpus, EveryFileGetsItsCodeAndReasonAndLeavesNothing) {
  const test::TemporaryFolder results;
  std::size_t broken = 0;
  std::map<int, int> codes;
  for (const test::CorpusCase& file : cases_) {
    SCOPED_TRACE(file.name);
    const test::ProgramResult result = run(bakeArguments(file, results / "out.glb"));
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
