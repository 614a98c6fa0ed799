// The same input and options give the same bytes, whatever else differs.
#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "core/random.h"
#include "hostile/batch_fixture.h"

namespace jalousie {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int kRuns = 3;  // each takes several times as long
#else
constexpr int kRuns = 10;
#endif

struct Options {
  const char* name;
  std::vector<std::string> words;
};

class Determinism : public test::BatchFixture, public testing::WithParamInterface<Options> {
 protected:
  std::map<std::string, std::vector<std::byte>> bake(std::vector<std::string> more = {},
                                                     const test::ProgramSetup& setup = {},
                                                     const std::string& program = JALOUSIE_BAKE_PROGRAM) const {
    std::filesystem::remove_all(folder_ / "out");
    std::vector<std::string> arguments = {"-o", at("out/"), "-q"};
    arguments.insert(arguments.end(), GetParam().words.begin(), GetParam().words.end());
    if (std::none_of(more.begin(), more.end(), [](const std::string& word) { return word.ends_with(".ply"); }))
      more.push_back(at("in"));
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::ProgramResult result = test::runProgram(program, arguments, setup);
    EXPECT_EQ(result.exitCode, 0) << result.standardError;
    return contents("out");
  }
  std::vector<std::string> shuffledInputs(std::uint32_t seed) const {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "in"))
      files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    Random random(seed);
    for (std::size_t i = files.size(); i > 1; --i)
      std::swap(files[i - 1], files[random.below(static_cast<std::uint32_t>(i))]);
    return files;
  }
};

TEST_P(Determinism, ManyRunsOneResult) {
  const auto expected = bake();
  ASSERT_EQ(expected.size(), 7U);
  for (int run = 1; run < kRuns; ++run)
    ASSERT_EQ(bake(), expected) << run;
}

TEST_P(Determinism, JobsOrderAndLocaleChangeNothing) {
  const auto expected = bake();
  for (const char* jobs : {"1", "2", "8"})
    EXPECT_EQ(bake({"-j", jobs}), expected) << jobs;
  for (const std::uint32_t seed : {1U, 2U, 3U})
    EXPECT_EQ(bake(shuffledInputs(seed)), expected) << seed;
  for (const char* locale : {"LC_ALL=C", "LC_ALL=de_DE.UTF-8", "LC_ALL=tr_TR.UTF-8", "LC_ALL=C.UTF-8"})
    EXPECT_EQ(bake({}, {.environment = {locale, "TZ=Asia/Kathmandu"}}), expected) << locale;
}

TEST_P(Determinism, OtherBuildsGiveTheSameBytes) {
  const char* others = std::getenv("JALOUSIE_OTHER_BAKERS");
  if (others == nullptr)
    GTEST_SKIP() << "JALOUSIE_OTHER_BAKERS names no bakers of other builds; scripts/test --asan does";
  const auto expected = bake();
  std::istringstream list(others);
  for (std::string program; std::getline(list, program, ':');)
    EXPECT_EQ(bake({}, {}, program), expected) << program;
}

INSTANTIATE_TEST_SUITE_P(Options, Determinism,
                         testing::Values(Options{"draft", {"--preset", "draft", "--cells", "64"}},
                                         Options{"fast", {"--preset", "fast", "--quantize"}},
                                         Options{"best", {"--levels", "4", "--samples", "2000", "--compress"}}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace jalousie
