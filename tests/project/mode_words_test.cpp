// Culling modes are told apart by the traits of their row in src/policy. No other source compares names or ids of
// modes.
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "project/source_files.h"

namespace jalousie {
namespace {

/// Lines of the text that compare with the name of a mode or use a mode's constant, each after "NAME:LINE: ".
std::vector<std::string> modeWords(const std::string& name, const std::string& text) {
  static const std::string kName =
      R"re("(hom|hom-depth|hiz|frustum|full|query-[a-z]+|chc(-flat|\+\+)?|nested-grid|eye-siding)")re";
  static const std::regex kModeWord(
      "[!=]=\\s*" + kName + "|" + kName +
      R"(\s*[!=]=|\bkCull([A-Z]\w*)?\b)"
      R"(|([!=<>]=|[<>])\s*CullMode::k|CullMode::k\w+\s*([!=<>]=|[<>])|case CullMode::k)");
  std::vector<std::string> found;
  std::istringstream lines(text);
  int number = 1;
  for (std::string line; std::getline(lines, line); ++number)
    if (std::regex_search(line, kModeWord)) found.push_back(name + ":" + std::to_string(number) + ": " + line);
  return found;
}

TEST(ModeWords, OnlyTheTableOfModesKnowsThem) {
  std::size_t files = 0;
  for (const std::string& file : test::sourceFiles({"src", "preprocess", "bench", "shaders"})) {
    if (file.starts_with("src/policy/") || file == "src/render/methods/method_table.cpp") continue;
    ++files;
    for (const std::string& line : modeWords(file, test::sourceText(file)))
      ADD_FAILURE() << line;
  }
  EXPECT_GT(files, 200U);
}

TEST(ModeWords, AreFoundInEverySpelling) {
  for (const char* line :
       {"if (mode == \"hom\")", "if (\"hiz\" != mode)", "mode==\"hom-depth\";", "return options.mode == \"frustum\";",
        "x != \"full\"", "view.cullMode >= kCullHom", "gpu::kCullNone", "// kCull is a prefix",
        "mode == CullMode::kHiz", "CullMode::kHom <= mode", "case CullMode::kFull:"})
    EXPECT_EQ(modeWords("x", line).size(), 1U) << line;
  for (const char* line : {"drag_ = Drag::kCulling;", "{\"hom\", \"the thesis\"}", "culling(mode)",
                           "if (x == \"home\")", "options.cullMode = other;", "settle(renderer, CullMode::kHiz)"})
    EXPECT_EQ(modeWords("x", line).size(), 0U) << line;
}

}  // namespace
}  // namespace jalousie
