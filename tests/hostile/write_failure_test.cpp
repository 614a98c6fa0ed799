// Writes that fail: the disk is full, or the Nth call of a function returns an error.
#include <algorithm>

#include "hostile/batch_fixture.h"

namespace jalousie {
namespace {

using test::ProgramResult;

class WriteFailure : public test::BatchFixture {
 protected:
  ProgramResult bake(std::vector<std::string> arguments, const test::ProgramSetup& setup = {}) const {
    arguments.insert(arguments.end(), {"--preset", "draft", "-q"});
    return test::runProgram(JALOUSIE_BAKE_PROGRAM, arguments, setup);
  }
  static std::size_t linesOf(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }
};

TEST_F(WriteFailure, EveryFailingCallIsOneLineAndTheOldFileStays) {
  for (const char* function : {"write", "fsync", "linkat", "rename"}) {
    std::filesystem::create_directories(folder_ / "out");
    ASSERT_EQ(bake({at("in/ball3.ply"), "-o", at("out/a.glb"), "--levels", "2"}).exitCode, 0);
    const auto old = contents("out").at("a.glb");
    int failures = 0;
    for (int call = 1;; ++call) {
      SCOPED_TRACE(std::string(function) + " " + std::to_string(call));
      ASSERT_LT(call, 50);
      // The preloaded library comes before the sanitizer's, which minds.
      const ProgramResult result =
          bake({at("in/ball3.ply"), "-o", at("out/a.glb")},
               {.environment = {std::string("LD_PRELOAD=") + JALOUSIE_FAILING_CALLS,
                                std::string("JALOUSIE_FAIL=") + function + ":" + std::to_string(call),
                                "ASAN_OPTIONS=verify_asan_link_order=0"}});
      const auto now = contents("out");
      EXPECT_EQ(now.size(), 1U) << "something was left behind";
      if (result.exitCode == 0) {
        EXPECT_NE(now.at("a.glb"), old);
        break;
      }
      ++failures;
      EXPECT_EQ(result.exitCode, 8) << result.standardError;
      EXPECT_EQ(linesOf(result.standardError), 1U) << result.standardError;
      EXPECT_NE(result.standardError.find("a.glb"), std::string::npos) << result.standardError;
      // The folder is synced last: the new file is in place by then, and whole.
      const bool folderSync = std::string(function) == "fsync" && call == 2;
      EXPECT_EQ(now.at("a.glb") == old, !folderSync);
      writeFileAtomic(folder_ / "out/a.glb", old);
    }
    EXPECT_GE(failures, 1) << function << " was never called";
  }
}

TEST_F(WriteFailure, AFullDiskIsOneLineAndTheOldFileStays) {
  std::ofstream(folder_ / "script.sh") << R"(set -e
mkdir disk && mount -t tmpfs -o size=64k tmpfs disk 2>/dev/null || exit 77
cp old.glb disk/a.glb
set +e
"$1" large.ply -o disk/a.glb --preset draft -q 2> errors
echo $? > code
"$1" in large.ply -o disk/ --preset draft -q 2> batch-errors
echo $? > batch-code
cmp old.glb disk/a.glb && ls -A disk > listing
)";
  std::ofstream(folder_ / "large.ply") << test::spherePly(60, 40);
  ASSERT_EQ(bake({at("in/ball0.ply"), "-o", at("old.glb"), "--levels", "2"}).exitCode, 0);
  test::ProgramResult result;
  for (const std::vector<std::string>& unshare : {std::vector<std::string>{"-m"}, {"-rm"}}) {
    std::vector<std::string> arguments = unshare;
    arguments.insert(arguments.end(), {"sh", at("script.sh"), JALOUSIE_BAKE_PROGRAM});
    std::filesystem::remove_all(folder_ / "disk");
    result = test::runProgram("/usr/bin/unshare", arguments, {.folder = folder_.path()});
    if (result.exitCode == 0) break;
  }
  if (result.exitCode != 0) GTEST_SKIP() << "no small disk can be mounted here: " << result.standardError;
  const auto text = [&](const char* name) {
    std::ifstream stream(folder_ / name);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_EQ(text("code"), "8\n");
  EXPECT_EQ(linesOf(text("errors")), 1U) << text("errors");
  EXPECT_EQ(text("batch-code"), "11\n");
  EXPECT_EQ(text("listing").find(".jalousie"), std::string::npos) << text("listing");
  EXPECT_NE(text("listing").find("ball0.glb"), std::string::npos) << "small ones still fit: " << text("listing");
}

TEST_F(WriteFailure, ReportsAndDepfilesThatCannotBeWrittenAreErrors) {
  for (const char* option : {"--json", "--depfile"}) {
    const ProgramResult result = bake({at("in/quad.obj"), "-o", at("q.glb"), option, at("no/such/folder/file")});
    EXPECT_EQ(result.exitCode, 8) << option;
    EXPECT_EQ(linesOf(result.standardError), 1U) << result.standardError;
  }
}

}  // namespace
}  // namespace jalousie
