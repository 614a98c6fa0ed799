// Manual pages say what --help says, and nothing in them puzzles groff; the desktop entry is one.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "support/run_program.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

struct Page {
  const char* name;     ///< without ".1"
  const char* program;  ///< path
  const char* command;  ///< empty: the program itself
};

constexpr Page kPages[] = {
    {"jalousie", JALOUSIE_PROGRAM, ""},
    {"jalousie-render", JALOUSIE_PROGRAM, "render"},
    {"jalousie-view", JALOUSIE_PROGRAM, "view"},
    {"jalousie-compare", JALOUSIE_PROGRAM, "compare"},
    {"jalousie-diff", JALOUSIE_PROGRAM, "diff"},
    {"jalousie-record", JALOUSIE_PROGRAM, "record"},
    {"jalousie-bake", JALOUSIE_BAKE_PROGRAM, ""},
    {"jalousie-bake-inspect", JALOUSIE_BAKE_PROGRAM, "inspect"},
    {"jalousie-bake-cut", JALOUSIE_BAKE_PROGRAM, "cut"},
    {"jalousie-scatter", JALOUSIE_SCATTER_PROGRAM, ""},
    {"jalousie-wad", JALOUSIE_WAD_PROGRAM, ""},
};

std::string help(const Page& page) {
  std::vector<std::string> arguments;
  if (*page.command != '\0') arguments.emplace_back(page.command);
  arguments.emplace_back("--help");
  const test::ProgramResult result = test::runProgram(page.program, arguments);
  EXPECT_EQ(result.exitCode, 0) << page.name;
  return result.standardOutput;
}

/// Words without the marks of the page's format, one blank between any two.
std::string words(const std::string& page) {
  std::string text = std::regex_replace(page, std::regex(R"(\\f\(?[A-Z]+|\\f[BIPR]|\\,|\\/|\\&)"), "");
  text = std::regex_replace(text, std::regex(R"(\\-)"), "-");
  text = std::regex_replace(text, std::regex(R"(\\e|\\\(rs)"), "\\");
  text = std::regex_replace(text, std::regex(R"(\\\(aq|\\\(cq)"), "'");
  text = std::regex_replace(text, std::regex(R"((^|\n)\.[A-Z]+)"), "\n");
  return std::regex_replace(text, std::regex(R"(["\s]+)"), " ");
}

std::string readText(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(ManPages, SayEveryLineOfTheHelp) {
  for (const Page& page : kPages) {
    const fs::path file = fs::path(JALOUSIE_MAN_FOLDER) / (std::string(page.name) + ".1");
    ASSERT_TRUE(fs::exists(file)) << file;
    const std::string said = words(readText(file));
    std::istringstream lines(help(page));
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      // Headings become sections, and the usage line is set apart.
      if (line.ends_with(":") || line.starts_with("Usage:")) continue;
      if (line.starts_with("Exit codes: ")) line.erase(0, 12);
      std::istringstream parts(std::regex_replace(line, std::regex(R"( {2,})"), "\n"));
      for (std::string part; std::getline(parts, part);) {
        const std::string wanted = words(part);
        EXPECT_NE(said.find(wanted), std::string::npos) << page.name << " lacks: " << wanted;
      }
    }
    EXPECT_GT(count, 8) << page.name;
  }
}

TEST(ManPages, HaveTheirNameAndPleaseGroff) {
  for (const Page& page : kPages) {
    const fs::path file = fs::path(JALOUSIE_MAN_FOLDER) / (std::string(page.name) + ".1");
    std::string title = page.name;
    std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return std::toupper(c); });
    const std::string text = readText(file);
    EXPECT_NE(text.find("\n.TH " + title + " \"1\""), std::string::npos) << page.name;
    EXPECT_NE(words(text).find(std::string("NAME ") + page.name + " - "), std::string::npos) << page.name;
    const test::ProgramResult groff =
        test::runProgram("/usr/bin/env", {"groff", "-man", "-Tutf8", "-ww", "-z", file.string()});
    if (groff.exitCode == 127) GTEST_SKIP() << "no groff";
    EXPECT_EQ(groff.exitCode, 0) << page.name;
    EXPECT_EQ(groff.standardError, "") << page.name;
  }
}

TEST(DesktopEntry, IsValid) {
  const test::ProgramResult result = test::runProgram(
      "/usr/bin/env", {"desktop-file-validate", JALOUSIE_SOURCE_DIR "/assets/desktop/jalousie.desktop"});
  if (result.exitCode == 127) GTEST_SKIP() << "no desktop-file-validate";
  EXPECT_EQ(result.exitCode, 0) << result.standardOutput;
  EXPECT_EQ(result.standardOutput, "");
}

}  // namespace
}  // namespace jalousie
