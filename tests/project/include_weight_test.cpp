// What a program compiles when it includes a header: the number of lines and the libraries behind it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "project/source_files.h"
#include "support/run_program.h"

namespace jalousie {
namespace {

/// Lines of a program that includes render/frame_renderer.h alone, after the preprocessor (-E -P, GCC 12 of Debian 12).
/// glm and <array>, <memory>, <optional>, <span>, <string>, <vector> are 58,610 of them.
constexpr std::ptrdiff_t kMostLines = 60'000;

struct Weight {
  std::ptrdiff_t lines = 0;
  std::string headers;  ///< all headers read, one a line
  bool reads(const std::string& part) const { return headers.find(part) != std::string::npos; }
};

Weight weightOf(const std::string& header) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "program.cpp") << "#include \"" << header << "\"\n";
  std::vector<std::string> arguments = {"-std=c++20", "-E", "-P", "-H", (folder / "program.cpp").string()};
  std::istringstream folders(JALOUSIE_INCLUDE_FOLDERS);
  for (std::string name; std::getline(folders, name, ':');)
    arguments.push_back("-I" + name);
  const test::ProgramResult result = test::runProgram(JALOUSIE_COMPILER, arguments);
  EXPECT_EQ(result.exitCode, 0) << result.standardError;
  return {std::count(result.standardOutput.begin(), result.standardOutput.end(), '\n'), result.standardError};
}

TEST(IncludeWeight, FrameRendererHeaderIsLight) {
  const Weight weight = weightOf("render/frame_renderer.h");
  EXPECT_TRUE(weight.reads("render/frame_renderer.h"));
  EXPECT_FALSE(weight.reads("tiny_gltf.h"));
  EXPECT_FALSE(weight.reads("/epoxy/"));
  EXPECT_LT(weight.lines, kMostLines);
}

TEST(IncludeWeight, IsMeasured) {
  const Weight gl = weightOf("gl/handle.h");
  EXPECT_TRUE(gl.reads("/epoxy/"));
  EXPECT_FALSE(gl.reads("tiny_gltf.h"));
  const Weight gltf = weightOf("asset/gltf_file.h");
  EXPECT_TRUE(gltf.reads("tiny_gltf.h"));
  EXPECT_GT(gltf.lines, 20'000);
}

}  // namespace
}  // namespace jalousie
