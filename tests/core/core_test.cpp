// Errors, checks, files, random numbers, medians and boxes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <string>

#include "core/aabb.h"
#include "core/check.h"
#include "core/confined_folder.h"
#include "core/error.h"
#include "core/file.h"
#include "core/folder_lock.h"
#include "core/interruption.h"
#include "core/median.h"
#include "core/memory_estimate.h"
#include "core/random.h"
#include "core/standard_streams.h"
#include "support/run_program.h"

namespace jalousie {
namespace {

template <class Call>
ErrorCode codeOf(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

std::string textOf(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(Error, IsOneLineThatNamesTheFile) {
  const Error error(ErrorCode::kMalformed, "line one\nline two\t!\n", "some/file.ply");
  EXPECT_STREQ(error.what(), "some/file.ply: line one line two !");
  EXPECT_EQ(error.exitCode(), 5);
  EXPECT_EQ(errorName(error.code()), "malformed");
}

TEST(MemoryEstimate, RefusesWithNeedItemLimitAndOption) {
  MemoryEstimate needs;
  needs.add(16, 1U << 20U, "16 instances");
  EXPECT_NO_THROW(needs.require({16U << 20U, "--max-memory"}, "scene.glb")) << "exactly the limit is allowed";
  EXPECT_NO_THROW(needs.require({0, "--max-memory"}, "scene.glb")) << "0 is no limit";
  const auto refusal = [&](const MemoryLimit& limit) -> std::string {
    try {
      needs.require(limit, "scene.glb");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kLimit);
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal({8U << 20U, "--max-memory"}),
            "scene.glb: needs about 16 MiB for 16 instances, the limit is 8 MiB; --max-memory lifts it");
  needs.add(1, 10U << 20U, "textures");
  EXPECT_EQ(refusal({8U << 20U, nullptr}),
            "scene.glb: needs about 26 MiB, 16 MiB of them for 16 instances, the limit is 8 MiB");
}

TEST(MemoryEstimate, SumsAndProductsDoNotWrap) {
  MemoryEstimate needs;
  needs.add(~std::uint64_t{0} / 2, 3, "many");
  needs.add(5, 5, "few");
  EXPECT_EQ(needs.bytes(), ~std::uint64_t{0});
  EXPECT_EQ(needs.largestItem(), "many");
}

TEST(Check, FailureAbortsAndShowsBothValues) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const int have = 3;
  EXPECT_DEATH(JAL_CHECK(have < 2), "have < 2  with 3 < 2");
  JAL_CHECK(have == 3);
}

TEST(Interruption, EndsTheProgramAtOnceWithOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto interrupt = [](int signal) {
    endOnInterruptions("program");
    ::raise(signal);
  };
  EXPECT_EXIT(interrupt(SIGHUP), testing::ExitedWithCode(129), "^program: interrupted\n$");
  EXPECT_EXIT(interrupt(SIGINT), testing::ExitedWithCode(130), "^program: interrupted\n$");
  EXPECT_EXIT(interrupt(SIGTERM), testing::ExitedWithCode(143), "^program: interrupted\n$");
}

TEST(Interruption, WaitsWhileItIsDeferredUntilTheSecondSignal) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto once = [] {
    endOnInterruptions("program");
    const DeferredInterruptions deferred;
    ::raise(SIGTERM);
    std::_Exit(interrupted() ? interruptionExitCode() : 0);
  };
  const auto twice = [] {
    endOnInterruptions("program");
    const DeferredInterruptions deferred;
    ::raise(SIGTERM);
    ::raise(SIGINT);
    std::_Exit(0);
  };
  EXPECT_EXIT(once(), testing::ExitedWithCode(143), "^$");
  EXPECT_EXIT(twice(), testing::ExitedWithCode(130), "^program: interrupted\n$");
}

TEST(Interruption, IgnoredSignalsStayIgnoredAndHeldOnesWait) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto ignored = [] {
    ::signal(SIGHUP, SIG_IGN);
    endOnInterruptions("program");
    ::raise(SIGHUP);
    std::_Exit(7);
  };
  const auto held = [] {
    endOnInterruptions("program");
    {
      const HeldInterruptions hold;
      ::raise(SIGTERM);
      printError("held");
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(ignored(), testing::ExitedWithCode(7), "^$");
  EXPECT_EXIT(held(), testing::ExitedWithCode(143), "^held\nprogram: interrupted\n$");
}

TEST(FolderLock, AdmitsOneAtATime) {
  const test::TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    EXPECT_EQ(codeOf([&] { FolderLock(folder.path()); }), ErrorCode::kWriteFailed);
  }
  EXPECT_NO_THROW(FolderLock(folder.path()));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(File, WrittenBytesComeBackAndReplaceTheOldOnes) {
  const test::TemporaryFolder folder;
  writeFileAtomic(folder / "a", "first");
  writeFileAtomic(folder / "a", "second");
  EXPECT_EQ(textOf(readFile(folder / "a", 100)), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1)
      << "a temporary file was left behind";
}

TEST(File, FailedWriteKeepsTheOldContentAndLeavesNothing) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "taken");
  std::ofstream(folder / "taken" / "inside") << "x";
  EXPECT_EQ(codeOf([&] { writeFileAtomic(folder / "taken", "text"); }), ErrorCode::kWriteFailed);
  EXPECT_TRUE(std::filesystem::exists(folder / "taken" / "inside"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  EXPECT_EQ(codeOf([&] { writeFileAtomic(folder / "no/such/folder/file", "text"); }), ErrorCode::kWriteFailed);
}

TEST(File, OnlyRegularFilesWithinTheLimitAreRead) {
  const test::TemporaryFolder folder;
  writeFileAtomic(folder / "a", "12345");
  EXPECT_EQ(codeOf([&] { readFile(folder / "a", 4); }), ErrorCode::kLimit);
  EXPECT_EQ(codeOf([&] { readFile(folder / "missing", 4); }), ErrorCode::kFileNotFound);
  EXPECT_EQ(codeOf([&] { readFile(folder.path(), 4); }), ErrorCode::kFileUnreadable);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(codeOf([&] { readFile(folder / "pipe", 4); }), ErrorCode::kFileUnreadable)
      << "and does not wait for a writer";
  EXPECT_EQ(codeOf([&] { readFile("/dev/zero", 4); }), ErrorCode::kFileUnreadable);
}

TEST(File, AbandonedPartsGoAndLivingOnesStay) {
  const test::TemporaryFolder folder;
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  const std::string prefix = std::string(".jalousie-") + host + "-";
  const std::vector<std::string> others = {".jalousie-notes.txt", ".jalousie-1-0",     "jalousie-3-0",
                                           prefix + "x-1",        prefix + "1-2.json", ".jalousie-another-host-1-0"};
  for (const std::string& name : others)
    std::ofstream(folder / name) << "somebody's file";
  std::ofstream(folder / (prefix + "1-0")) << "left by a program that was killed";
  std::ofstream(folder / (prefix + "2-0")) << "being written";
  const int living = ::open((folder / (prefix + "2-0")).c_str(), O_RDONLY);
  ASSERT_EQ(::flock(living, LOCK_EX), 0);
  removeAbandonedFiles(folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder / (prefix + "1-0")));
  EXPECT_TRUE(std::filesystem::exists(folder / (prefix + "2-0")));
  for (const std::string& name : others)
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  ::close(living);
  removeAbandonedFiles(folder / "missing");
}

TEST(File, LinksAreFollowedAndPipesStayPipes) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "real");
  writeFileAtomic(folder / "real/a", "old");
  std::filesystem::create_symlink("real/a", folder / "link");
  writeFileAtomic(folder / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(textOf(readFile(folder / "real/a", 100)), "new");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  const int reader = ::open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  writeFileAtomic(folder / "pipe", "text");
  char buffer[8] = {};
  EXPECT_EQ(::read(reader, buffer, sizeof buffer), 4);
  ::close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
}

TEST(Error, ControlCharactersAreSpaces) {
  EXPECT_EQ(oneLine("a\x1b]0;b\x07\nc\xC2\x9B"
                    "d\n"),
            "a ]0;b  c  d");
  EXPECT_EQ(oneLine("gr\xC3\xBCn"), "gr\xC3\xBCn");
}

class ConfinedFolderTest : public testing::TestWithParam<ConfinedFolder::Lookup> {
 protected:
  ConfinedFolderTest() {
    std::filesystem::create_directories(folder_ / "in/sub");
    std::ofstream(folder_ / "outside.bin") << "outside";
    std::ofstream(folder_ / "in/a.bin") << "inside";
    std::ofstream(folder_ / "in/sub/b c.bin") << "deeper";
    std::filesystem::create_symlink(folder_ / "outside.bin", folder_ / "in/absolute");
    std::filesystem::create_symlink("../outside.bin", folder_ / "in/relative");
    std::filesystem::create_symlink("..", folder_ / "in/up");
    std::filesystem::create_symlink("a.bin", folder_ / "in/beside");
    ::mkfifo((folder_ / "in/pipe").c_str(), 0600);
  }
  /// The text of a file, or the name of the error.
  std::string read(const std::string& name) const {
    try {
      return textOf(ConfinedFolder(folder_ / "in", GetParam()).readFile(name, 100));
    } catch (const Error& error) {
      return std::string(errorName(error.code()));
    }
  }
  const test::TemporaryFolder folder_;
};

TEST_P(ConfinedFolderTest, ReadsWhatLiesInside) {
  EXPECT_EQ(read("a.bin"), "inside");
  EXPECT_EQ(read("./sub//b c.bin"), "deeper");
  EXPECT_EQ(read("sub/../a.bin"), "inside");
}

TEST_P(ConfinedFolderTest, RefusesWhatLeadsOut) {
  for (const char* name : {"../outside.bin", "sub/../../outside.bin", "/etc/passwd", "absolute", "relative",
                           "up/outside.bin", "..", "../in/a.bin", "sub/../../in/a.bin"})
    EXPECT_EQ(read(name), "unsupported") << name;
}

TEST_P(ConfinedFolderTest, RefusesWhatIsNoFile) {
  for (const char* name : {"sub", ".", "pipe", "sub/.."})
    EXPECT_EQ(read(name), "file-unreadable") << name;
  for (const char* name : {"missing", "a.bin/x", "sub/missing", "b c.bin"})
    EXPECT_EQ(read(name), "file-not-found") << name;
  EXPECT_EQ(read(""), "malformed");
  EXPECT_EQ(read(std::string("a.bin\0", 6)), "malformed");
}

TEST_P(ConfinedFolderTest, LinksInsideAreFollowedByTheKernelOnly) {
  EXPECT_EQ(read("beside"), GetParam() == ConfinedFolder::Lookup::kKernel ? "inside" : "unsupported");
}

INSTANTIATE_TEST_SUITE_P(Lookups, ConfinedFolderTest,
                         testing::Values(ConfinedFolder::Lookup::kKernel, ConfinedFolder::Lookup::kByComponent));

TEST(Random, SameSeedSameSequence) {
  Random a(42);
  Random b(42);
  Random c(43);
  int different = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t value = a.next();
    EXPECT_EQ(value, b.next());
    different += value != c.next() ? 1 : 0;
  }
  EXPECT_GT(different, 990);
}

TEST(Random, UniformStaysInRangeAndCoversIt) {
  Random random(1);
  double sum = 0.0;
  std::set<std::uint32_t> dice;
  for (int i = 0; i < 100000; ++i) {
    const float value = random.uniform();
    ASSERT_GE(value, 0.0F);
    ASSERT_LT(value, 1.0F);
    sum += value;
    dice.insert(random.below(6));
  }
  EXPECT_NEAR(sum / 100000, 0.5, 0.005);
  EXPECT_EQ(dice, (std::set<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

TEST(Median, IsTheMiddleValueOrTheLargerOfTwo) {
  EXPECT_EQ(median<double>({3.5}), 3.5);
  EXPECT_EQ(median<double>({9.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median<double>({4.0, 1.0, 3.0, 2.0}), 3.0);
  EXPECT_EQ(median<float>({1.0F, 1.0F, 100.0F}), 1.0F);
}

TEST(Aabb, GrowsTransformsAndKnowsWhenItIsEmpty) {
  Aabb box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.diagonal(), 0.0F);
  box.add(glm::vec3(1, 2, 3));
  box.add(glm::vec3(-1, 0, 3));
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.center(), glm::vec3(0, 1, 3));
  const Aabb moved = transformed(glm::scale(glm::mat4(1.0F), {-2, 1, 1}), box);
  EXPECT_EQ(moved.min, glm::vec3(-2, 0, 3));
  EXPECT_EQ(moved.max, glm::vec3(2, 2, 3));
}

}  // namespace
}  // namespace jalousie
