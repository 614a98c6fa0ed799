// Command lines that every program refuses before it works: empty values, and outputs that cannot be written.
#include <unistd.h>

#include <regex>
#include <sstream>

#include "programs/programs_fixture.h"

namespace jalousie {
namespace {

using test::Command;
using test::ProgramResult;

/// A command without its options, and what it needs: an option and its value, or a positional ("").
struct Needs {
  const char* program;
  const char* command;
  std::vector<std::pair<std::string, std::string>> words;
};

class CommandLineTest : public test::ProgramsTest {
 protected:
  static std::vector<Needs> commands() {
    return {
        {JALOUSIE_PROGRAM, "render", {{"", "scene.glb"}, {"--output", "out.png"}}},
        {JALOUSIE_PROGRAM, "view", {{"", "scene.glb"}}},
        {JALOUSIE_PROGRAM, "compare", {{"", "scene.glb"}, {"--output", "report"}}},
        {JALOUSIE_PROGRAM, "diff", {{"", "a.png"}, {"", "b.png"}}},
        {JALOUSIE_PROGRAM, "record", {{"", "scene.glb"}, {"--output", "path.glb"}}},
        {JALOUSIE_BAKE_PROGRAM, "", {{"", "ball.ply"}, {"--output", "out.glb"}}},
        {JALOUSIE_BAKE_PROGRAM, "inspect", {{"", "ball.glb"}}},
        {JALOUSIE_SCATTER_PROGRAM, "", {{"", "ball.glb"}, {"--output", "out.glb"}, {"--count", "2"}}},
        {JALOUSIE_WAD_PROGRAM, "", {{"", "level.wad"}, {"--output", "out.glb"}, {"--map", "E1M1"}}},
    };
  }
  static std::vector<std::string> start(const Needs& needs) {
    return *needs.command == '\0' ? std::vector<std::string>() : std::vector<std::string>{needs.command};
  }
  /// Long names of the options that take a value, from the help.
  static std::vector<std::string> valueOptions(const Needs& needs) {
    std::vector<std::string> words = start(needs);
    words.emplace_back("--help");
    std::istringstream help(run({needs.program, words}).standardOutput);
    const std::regex option(R"(^  (?:-\w,)?(--[a-z-]+) [^ (].*)");
    std::vector<std::string> names;
    std::smatch match;
    for (std::string line; std::getline(help, line);)
      if (std::regex_match(line, match, option)) names.push_back(match[1]);
    return names;
  }
  static void expectEmptyRefused(const Needs& needs, std::vector<std::string> words, const std::string& name) {
    const ProgramResult result = run({needs.program, std::move(words)});
    EXPECT_EQ(result.exitCode, 2) << result.standardError;
    EXPECT_EQ(test::linesOf(result.standardError), 1) << result.standardError;
    EXPECT_NE(result.standardError.find(name), std::string::npos) << result.standardError;
  }
};

TEST_F(CommandLineTest, NoOptionAcceptsAnEmptyValue) {
  std::size_t count = 0;
  for (const Needs& needs : commands()) {
    for (const std::string& name : valueOptions(needs)) {
      SCOPED_TRACE(std::string(needs.command) + " " + name);
      std::vector<std::string> words = start(needs);
      for (const auto& [option, value] : needs.words) {
        if (option == name) continue;
        if (!option.empty()) words.push_back(option);
        words.push_back(value);
      }
      words.insert(words.end(), {name, ""});
      expectEmptyRefused(needs, words, name);
      ++count;
    }
  }
  EXPECT_GE(count, 120U) << "the help was not read";
}

TEST_F(CommandLineTest, NoPositionalAcceptsAnEmptyValue) {
  for (const Needs& needs : commands()) {
    for (std::size_t empty = 0; empty < needs.words.size() && needs.words[empty].first.empty(); ++empty) {
      SCOPED_TRACE(needs.command);
      std::vector<std::string> words = start(needs);
      for (std::size_t i = 0; i < needs.words.size(); ++i) {
        if (!needs.words[i].first.empty()) words.push_back(needs.words[i].first);
        words.push_back(i == empty ? "" : needs.words[i].second);
      }
      expectEmptyRefused(needs, words, "the value is empty");
    }
  }
}

TEST_F(CommandLineTest, ConfigurationsRefuseEmptyValuesToo) {
  const Command command = {JALOUSIE_PROGRAM, {"compare", "scene.glb", "-o", "report", "--config", "a=--importance ''"}};
  EXPECT_EQ(run(command).exitCode, 2);
  EXPECT_FALSE(exists("report"));
}

struct BadOutput {
  Command command;
  int exitCode;
  const char* reason;
};

// The inputs are missing in the cases with code 8: the outputs are checked before they are read.
std::vector<BadOutput> badOutputs() {
  const char* const jalousie = JALOUSIE_PROGRAM;
  const char* const bake = JALOUSIE_BAKE_PROGRAM;
  const char* const scatter = JALOUSIE_SCATTER_PROGRAM;
  return {
      {{jalousie, {"render", "none.glb", "-o", "folder"}}, 8, "folder: is a folder"},
      {{jalousie, {"render", "none.glb", "-o", "new/"}}, 8, "new/: is a folder"},
      {{jalousie, {"render", "none.glb", "-o", "no/a.png"}}, 8, "the folder no does not exist"},
      {{jalousie, {"render", "none.glb", "-o", "a.png", "--json", "no/a.json"}}, 8, "the folder no does not exist"},
      {{jalousie, {"render", "none.glb", "-o", "ball.ply/a.png"}}, 8, "ball.ply is not a folder"},
      {{jalousie, {"render", "scene.glb", "-o", "scene.glb"}}, 2, "names an input file"},
      {{jalousie, {"render", "scene.glb", "-o", "link.glb"}}, 2, "names an input file"},
      {{jalousie, {"render", "scene.glb", "-o", "./folder/../scene.glb"}}, 2, "names an input file"},
      {{jalousie, {"render", "scene.glb", "-o", "a", "--json", "folder/../a"}}, 2, "name the same file"},
      {{jalousie, {"render", "scene.glb", "-o", "-", "--json", "-"}}, 2, "cannot go to standard output"},
      {{jalousie, {"render", "scene.glb", "-o", "/dev/stdout", "--json", "-"}}, 2, "name the same file"},
      {{jalousie, {"view", "none.glb", "--screenshot", "no/a.png"}}, 8, "the folder no does not exist"},
      {{jalousie, {"diff", "none.png", "none.png", "-o", "no/a.png"}}, 8, "the folder no does not exist"},
      {{jalousie, {"diff", "ball.ply", "ball.ply", "-o", "ball.ply"}}, 2, "names an input file"},
      {{jalousie, {"record", "none.glb", "-o", "folder"}}, 8, "folder: is a folder"},
      {{jalousie, {"record", "scene.glb", "-o", "scene.glb"}}, 2, "names an input file"},
      {{jalousie, {"compare", "none.glb", "-o", "ball.ply"}}, 8, "ball.ply: Not a directory"},
      {{jalousie, {"compare", "none.glb", "-o", "ball.ply/report"}}, 8, "ball.ply is not a folder"},
      {{jalousie, {"compare", "none.glb", "-o", "folder"}}, 2, "holds no report"},
      {{jalousie, {"compare", "none.glb", "-o", "report"}}, 2, "holds a report"},
      {{jalousie, {"render", "none.glb", "-o", "ball.ply"}}, 2, "another kind of file exists here"},
      {{jalousie, {"render", "none.glb", "-o", "a.png", "--json", "ball.glb"}}, 2, "a glTF scene exists here"},
      {{jalousie, {"view", "none.glb", "--screenshot", "path.glb"}}, 2, "a camera path exists here"},
      {{jalousie, {"record", "none.glb", "-o", "scene.glb"}}, 2, "would be replaced by a camera path"},
      {{jalousie, {"record", "none.glb", "-o", "scene.gltf"}}, 2, "a glTF scene exists here"},
      {{jalousie, {"diff", "none.png", "none.png", "-o", "report.json"}}, 2, "a JSON report exists here"},
      {{bake, {"ball.ply", "-o", "no/a.glb"}}, 8, "the folder no does not exist"},
      {{bake, {"ball.ply", "-o", "a.glb", "--depfile", "no/a.d"}}, 8, "the folder no does not exist"},
      {{bake, {"ball.ply", "-o", "a.glb", "--json", "folder"}}, 8, "folder: is a folder"},
      {{bake, {"ball.ply", "-o", "outs/", "--json", "no/a.json"}}, 8, "the folder no does not exist"},
      {{bake, {"ball.glb", "-o", "ball.glb"}}, 2, "names an input file"},
      {{bake, {"ball.ply", "-o", "path.glb"}}, 2, "a camera path exists here"},
      {{bake, {"ball.ply", "-o", "a.glb", "--depfile", "report.json"}}, 2, "replaced by a file of make rules"},
      {{bake, {"ball.ply", "-o", "taken/"}}, 2, "taken/ball.glb: another kind of file exists here"},
      {{bake, {"inspect", "ball.glb", "--sheet", "scene.glb"}}, 2, "would be replaced by a page"},
      {{bake, {"ball.glb", "-o", "a.glb", "--sheet", "a.glb"}}, 2, "name the same file"},
      {{bake, {"ball.glb", "-o", "-", "--json", "-"}}, 2, "cannot go to standard output"},
      {{bake, {"inspect", "none.glb", "--sheet", "no/a.html"}}, 8, "the folder no does not exist"},
      {{bake, {"inspect", "ball.glb", "--sheet", "ball.glb"}}, 2, "names an input file"},
      {{scatter, {"ball.glb", "--count", "2", "-o", "a.png"}}, 2, "give it a name that ends in .glb, not .png"},
      {{scatter, {"none.glb", "--count", "2", "-o", "no/a.glb"}}, 8, "the folder no does not exist"},
      {{scatter, {"ball.glb", "--count", "2", "-o", "ball.glb"}}, 2, "names an input file"},
      {{scatter, {"ball.glb", "--count", "2", "-o", "report.json"}}, 2, "would be replaced by a glTF scene"},
      {{scatter, {"ball.glb", "--count", "2", "-o", "a", "--json", "a"}}, 2, "name the same file"},
      {{scatter, {"ball.glb", "--count", "2", "-o", "-", "--json", "-"}}, 2, "cannot go to standard output"},
  };
}

TEST_F(CommandLineTest, OutputsReplaceFilesOfTheirKindAndOthersByForce) {
  const Command record = {JALOUSIE_PROGRAM, {"record", "scene.glb", "-o", "path.glb", "-q"}};
  EXPECT_EQ(run(record).exitCode, 0);
  EXPECT_EQ(run(record).exitCode, 0) << "a camera path replaces a camera path";
  std::ofstream(at("letter.txt")) << "dear reader";
  Command bake = {JALOUSIE_BAKE_PROGRAM, {"ball.ply", "-o", "letter.txt", "--preset", "draft", "-q"}};
  EXPECT_EQ(run(bake).exitCode, 2);
  bake.arguments.push_back("--force");
  EXPECT_EQ(run(bake).exitCode, 0);
  bake.arguments.pop_back();
  EXPECT_EQ(run(bake).exitCode, 0) << "a scene replaces a scene";
  bake.arguments = {"ball.glb", "-o", "ball.glb", "--force"};
  EXPECT_EQ(run(bake).exitCode, 2) << "an input is never replaced";
  std::ofstream(at("empty")).close();
  EXPECT_EQ(run({JALOUSIE_PROGRAM, {"record", "scene.glb", "-o", "empty", "-q"}}).exitCode, 0);
}

TEST_F(CommandLineTest, OutputsThatCannotBeWrittenAreRefusedFirst) {
  std::filesystem::create_directory(at("folder"));
  std::ofstream(at("folder/letter.txt")) << "dear reader";
  std::filesystem::create_symlink("scene.glb", at("link.glb"));
  std::filesystem::create_directory(at("taken"));
  std::ofstream(at("taken/ball.glb")) << "dear reader";
  std::filesystem::create_directory(at("report"));
  std::ofstream(at("report/run.jsonl")) << R"({"log": 1, "experiment": "0"})"
                                        << "\n";
  std::ofstream(at("report.json")) << R"({"figures": []})";
  std::ofstream(at("scene.gltf")) << R"({"meshes": [], "asset": {"version": "2.0"}})";
  ASSERT_EQ(run({JALOUSIE_PROGRAM, {"record", "scene.glb", "-o", "path.glb", "-q"}}).exitCode, 0);
  const std::string scene = test::readText(at("scene.glb"));
  for (const BadOutput& bad : badOutputs()) {
    SCOPED_TRACE(bad.command.text());
    const ProgramResult result = run(bad.command);
    EXPECT_EQ(result.exitCode, bad.exitCode) << result.standardError;
    EXPECT_EQ(test::linesOf(result.standardError), 1) << result.standardError;
    EXPECT_NE(result.standardError.find(bad.reason), std::string::npos) << result.standardError;
  }
  EXPECT_EQ(test::readText(at("scene.glb")), scene);
  EXPECT_EQ(test::readText(at("taken/ball.glb")), "dear reader");
  EXPECT_EQ(test::readText(at("report.json")), R"({"figures": []})");
  EXPECT_FALSE(exists("a") || exists("a.glb") || exists("a.png") || exists("outs"));
}

TEST_F(CommandLineTest, AFolderWithoutWritePermissionIsRefusedFirst) {
  std::filesystem::create_directory(at("closed"));
  std::filesystem::permissions(at("closed"), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  if (::access(at("closed").c_str(), W_OK) == 0) GTEST_SKIP() << "this user may write everywhere";
  for (const Command& command :
       std::vector<Command>{{JALOUSIE_PROGRAM, {"render", "none.glb", "-o", "closed/a.png"}},
                            {JALOUSIE_PROGRAM, {"compare", "none.glb", "-o", "closed/report"}},
                            {JALOUSIE_PROGRAM, {"compare", "none.glb", "-o", "closed"}},
                            {JALOUSIE_BAKE_PROGRAM, {"ball.ply", "-o", "closed/a.glb"}},
                            {JALOUSIE_SCATTER_PROGRAM, {"none.glb", "--count", "2", "-o", "closed/a.glb"}}}) {
    const ProgramResult result = run(command);
    EXPECT_EQ(result.exitCode, 8) << command.text() << result.standardError;
    EXPECT_NE(result.standardError.find("cannot be written: Permission denied"), std::string::npos)
        << result.standardError;
  }
}

TEST_F(CommandLineTest, EveryHelpNamesTheExitCodesInTheSameWords) {
  const std::string codes =
      "Exit codes: 0 done, 2 command line, 3 file not found, 4 cannot be read, 5 malformed, 6 not supported, 7 over a";
  for (const Needs& needs : commands()) {
    std::vector<std::string> words = start(needs);
    words.emplace_back("--help");
    const std::string help = run({needs.program, words}).standardOutput;
    EXPECT_NE(help.find(codes), std::string::npos) << needs.command;
    EXPECT_NE(help.find("129, 130, 143 interrupted by SIGHUP, SIGINT, SIGTERM"), std::string::npos) << needs.command;
  }
}

}  // namespace
}  // namespace jalousie
