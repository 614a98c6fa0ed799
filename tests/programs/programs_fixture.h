// A small scene with its files, and the commands of all programs that read them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/scenes.h"

namespace jalousie::test {

/// A program and its arguments. Files are in the fixture's folder, where the command runs.
struct Command {
  const char* program;
  std::vector<std::string> arguments;

  std::string text() const {
    std::string text = std::filesystem::path(program).filename();
    for (const std::string& argument : arguments)
      text += " " + (argument.empty() ? "''" : argument);
    return text;
  }
};

inline std::string readText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline long linesOf(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

class ProgramsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    std::ofstream(*folder_ / "ball.ply") << spherePly(32, 16);
    ASSERT_EQ(run({JALOUSIE_BAKE_PROGRAM, {"ball.ply", "-o", "ball.glb", "--preset", "draft", "-q"}}).exitCode, 0);
    ASSERT_EQ(run({JALOUSIE_SCATTER_PROGRAM, {"ball.glb", "--count", "20", "-o", "scene.glb", "-q"}}).exitCode, 0);
    const ProgramResult drawn =
        run({JALOUSIE_PROGRAM, {"render", "scene.glb", "-o", "frame.png", "--size", "64x36", "-q"}});
    hasGl_ = drawn.exitCode != 9;
    ASSERT_TRUE(drawn.exitCode == 0 || !hasGl_) << drawn.standardError;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static ProgramResult run(const Command& command, ProgramSetup setup = {}) {
    setup.folder = folder_->path();
    return runProgram(command.program, command.arguments, setup);
  }
  static std::filesystem::path at(const std::string& name) { return *folder_ / name; }
  static bool exists(const std::string& name) { return std::filesystem::exists(at(name)); }

  static std::unique_ptr<TemporaryFolder> folder_;
  static bool hasGl_;
};
inline std::unique_ptr<TemporaryFolder> ProgramsTest::folder_;
inline bool ProgramsTest::hasGl_ = false;

}  // namespace jalousie::test
