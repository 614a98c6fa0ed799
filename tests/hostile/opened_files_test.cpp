// The baker opens nothing outside the folder of its input, whatever the input asks for.
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "support/corpus.h"
#include "support/opened_files.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

class OpenedFiles : public test::CorpusTest {};

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

TEST_F(OpenedFiles, NothingOutsideItsFolderIsOpened) {
  const test::TemporaryFolder results;
  const fs::path outputs = fs::canonical(results.path());
  for (const test::CorpusCase& file : cases_) {
    SCOPED_TRACE(file.name);
    const std::optional<std::set<fs::path>> opened =
        test::filesOpenedBy(JALOUSIE_BAKE_PROGRAM, bakeArguments(file, results / "out.glb"));
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

TEST_F(OpenedFiles, AreThoseOfTheProgramAndOfNoOther) {
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

}  // namespace
}  // namespace jalousie
