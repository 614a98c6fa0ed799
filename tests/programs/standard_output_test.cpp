// Output that cannot be written to standard output is exit code 8 in every program.
#include "programs/programs_fixture.h"

namespace jalousie {
namespace {

using test::Command;
using test::ProgramResult;
using test::StandardOutput;

class StandardOutputTest : public test::ProgramsTest {
 protected:
  static std::vector<Command> commands() {
    std::vector<Command> commands;
    for (const char* command : {"render", "view", "compare", "diff", "record"})
      commands.push_back({JALOUSIE_PROGRAM, {command, "--help"}});
    for (const char* program : {JALOUSIE_PROGRAM, JALOUSIE_BAKE_PROGRAM})
      commands.push_back({program, {"--version"}});
    for (const char* program :
         {JALOUSIE_PROGRAM, JALOUSIE_BAKE_PROGRAM, JALOUSIE_SCATTER_PROGRAM, JALOUSIE_WAD_PROGRAM})
      commands.push_back({program, {"--help"}});
    const std::vector<Command> results = {
        {JALOUSIE_BAKE_PROGRAM, {"inspect", "--help"}},
        {JALOUSIE_BAKE_PROGRAM, {"inspect", "ball.glb"}},
        {JALOUSIE_BAKE_PROGRAM, {"inspect", "ball.glb", "--json"}},
        {JALOUSIE_BAKE_PROGRAM, {"ball.ply", "-o", "out.glb", "--preset", "draft"}},
        {JALOUSIE_BAKE_PROGRAM, {"ball.ply", "-o", "out.glb", "--preset", "draft", "--json", "-"}},
        {JALOUSIE_BAKE_PROGRAM, {"ball.ply", "-o", "outs/", "--preset", "draft", "-q", "--json", "-"}},
        {JALOUSIE_SCATTER_PROGRAM, {"ball.glb", "--count", "2", "-o", "out.glb"}},
        {JALOUSIE_SCATTER_PROGRAM, {"ball.glb", "--count", "2", "-o", "out.glb", "--json", "-"}},
        {JALOUSIE_PROGRAM, {"record", "scene.glb", "-o", "path.glb"}},
    };
    commands.insert(commands.end(), results.begin(), results.end());
    if (!hasGl_) return commands;
    const std::vector<Command> drawn = {
        {JALOUSIE_PROGRAM, {"diff", "frame.png", "frame.png"}},
        {JALOUSIE_PROGRAM, {"diff", "frame.png", "frame.png", "--json", "-"}},
        {JALOUSIE_PROGRAM, {"render", "scene.glb", "-o", "out.png", "--size", "64x36"}},
        {JALOUSIE_PROGRAM, {"render", "scene.glb", "--stats-only", "--size", "64x36", "--json", "-"}},
        {JALOUSIE_PROGRAM,
         {"compare", "scene.glb", "-o", "report", "--force", "--frames", "0", "--size", "64x36", "--keep", "0", "-q",
          "--json", "-"}},
    };
    commands.insert(commands.end(), drawn.begin(), drawn.end());
    return commands;
  }
};

TEST_F(StandardOutputTest, FailuresAreExitCodeEightAndOneLine) {
  for (const Command& command : commands()) {
    SCOPED_TRACE(command.text());
    const ProgramResult full = run(command, {.output = StandardOutput::kFull});
    EXPECT_EQ(full.exitCode, 8);
    EXPECT_EQ(test::linesOf(full.standardError), 1) << full.standardError;
    EXPECT_NE(full.standardError.find("standard output: No space left on device"), std::string::npos)
        << full.standardError;
    const ProgramResult closed = run(command, {.output = StandardOutput::kClosed});
    EXPECT_EQ(closed.exitCode, 8);
    EXPECT_NE(closed.standardError.find("standard output: is closed"), std::string::npos) << closed.standardError;
    const ProgramResult unread = run(command, {.output = StandardOutput::kNoReader});
    EXPECT_EQ(unread.exitCode, 8);
    EXPECT_EQ(unread.standardError, "") << "the reader has what it wanted";
  }
}

TEST_F(StandardOutputTest, ClosedStreamsDoNotMatterToProgramsThatPrintNothing) {
  const Command scatter = {JALOUSIE_SCATTER_PROGRAM, {"ball.glb", "--count", "2", "-o", "quiet.glb", "-q"}};
  EXPECT_EQ(run(scatter, {.output = StandardOutput::kClosed}).exitCode, 0);
  const std::string whole = test::readText(at("quiet.glb"));
  EXPECT_TRUE(whole.starts_with("glTF"));
  const std::string command = std::string(JALOUSIE_SCATTER_PROGRAM) + " ball.glb --count 2 -o quiet.glb";
  EXPECT_EQ(run({"/bin/sh", {"-c", command + " -q <&- >&- 2>&-"}}).exitCode, 0);
  EXPECT_EQ(test::readText(at("quiet.glb")), whole) << "nothing was printed into the file";
}

TEST_F(StandardOutputTest, AStandardErrorThatFailsLeavesTheExitCode) {
  for (const char* target : {"2>/dev/full", "2>&-"}) {
    for (const char* program : {JALOUSIE_PROGRAM, JALOUSIE_BAKE_PROGRAM, JALOUSIE_SCATTER_PROGRAM}) {
      std::string words = program;
      if (words == JALOUSIE_PROGRAM) words += " record";
      if (words == JALOUSIE_SCATTER_PROGRAM) words += " --count 2";
      words.append(" none.glb -o never.glb ").append(target);
      EXPECT_EQ(run({"/bin/sh", {"-c", words}}).exitCode, 3) << words;
    }
  }
}

}  // namespace
}  // namespace jalousie
