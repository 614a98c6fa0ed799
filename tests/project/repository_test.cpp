// Rules about the files of the repository itself.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/run_program.h"
#include "support/source_root.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

bool isGenerated(const fs::path& path) {
  const std::string name = path.filename().string();
  return name == ".git" || name == "build" || name == "out" || name == "fetched" || name == ".cache";
}

TEST(Repository, HoldsNoFileOverOneMebibyte) {
  for (auto it = fs::recursive_directory_iterator(test::kSourceRoot); it != fs::recursive_directory_iterator(); ++it) {
    if (isGenerated(it->path())) {
      it.disable_recursion_pending();
    } else if (it->is_regular_file()) {
      EXPECT_LE(it->file_size(), 1U << 20U) << it->path();
    }
  }
}

TEST(Repository, ScriptsAreExecutable) {
  for (const char* script :
       {"scripts/setup", "scripts/demo", "scripts/test", "assets/fetch", "assets/make_mesh", "bench/bake_bench",
        "bench/bake_scene", "bench/back_faces", "bench/place_models.mjs", "bench/prove", ".ci/run"})
    EXPECT_NE(fs::status(test::kSourceRoot / script).permissions() & fs::perms::owner_exec, fs::perms::none) << script;
}

TEST(Repository, ScriptsExplainThemselvesAndRefuseUnknownOptions) {
  for (const char* script : {"scripts/setup", "scripts/demo", "assets/fetch", "bench/bake_bench", "bench/bake_scene",
                             "bench/back_faces", "bench/prove"}) {
    EXPECT_EQ(test::runProgram(test::kSourceRoot / script, {"--help"}).exitCode, 0) << script;
    EXPECT_EQ(test::runProgram(test::kSourceRoot / script, {"--no-such-option"}).exitCode, 2) << script;
  }
  const test::ProgramResult dryRun = test::runProgram(test::kSourceRoot / "scripts/setup", {"--dry-run"});
  EXPECT_EQ(dryRun.exitCode, 0);
  EXPECT_NE(dryRun.standardOutput.find("setup: "), std::string::npos);
}

TEST(Repository, UnreachableRegistryIsOneClearLine) {
  const test::TemporaryFolder folder;
  ::setenv("JALOUSIE_NPM_REGISTRY", "http://127.0.0.1:9", 1);
  const test::ProgramResult result =
      test::runProgram(test::kSourceRoot / "assets/fetch", {"--dest", folder.path().string(), "bunny"});
  ::unsetenv("JALOUSIE_NPM_REGISTRY");
  EXPECT_NE(result.exitCode, 0);
  EXPECT_NE(result.standardError.find("cannot reach the registry"), std::string::npos) << result.standardError;
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Repository, HelpOfTheProvingTableHasExamplesAndNamesUnseenScenes) {
  const std::string help = test::runProgram(test::kSourceRoot / "bench/prove", {"--help"}).standardOutput;
  EXPECT_NE(help.find("Examples:\n"), std::string::npos) << help;
  const std::size_t unseen = help.find("not used for any choice");
  ASSERT_NE(unseen, std::string::npos) << help;
  for (const char* scene : {"  forest ", "  landmarks ", "  house "})
    EXPECT_NE(help.find(scene, unseen), std::string::npos) << scene;
}

}  // namespace
}  // namespace jalousie
