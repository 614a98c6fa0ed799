// Includes and defines of the shader loader; needs no context.
#include "gl/shader_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "core/error.h"
#include "support/run_program.h"

namespace jalousie::gl {
namespace {

TEST(ShaderSource, ExpandsEachIncludeOnceAndKeepsLineNumbers) {
  const ExpandedShader shader = expandShader("visibility/classify.comp", {});
  EXPECT_TRUE(shader.text.starts_with("#version 450 core\n"));
  EXPECT_EQ(shader.text.find("#include \""), std::string::npos);
  EXPECT_EQ(std::set<std::string>(shader.files.begin(), shader.files.end()).size(), shader.files.size());
  EXPECT_EQ(shader.files.front(), "visibility/classify.comp");
  EXPECT_NE(shader.text.find("#line 1 1\n"), std::string::npos);
}

TEST(ShaderSource, DefinesFollowTheVersion) {
  const std::string_view defines[] = {"JAL_SHEET"};
  EXPECT_TRUE(
      expandShader("render/mesh.frag", defines).text.starts_with("#version 450 core\n#define JAL_SHEET 1\n#line"));
}

TEST(ShaderSource, UnknownFileAndMissingVersionAreErrors) {
  for (const char* name : {"no/such.comp", "lib/dct.glsl"}) {
    try {
      expandShader(name, {});
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kShader);
    }
  }
}

TEST(ShaderSource, FilesOfTheFolderReplaceEmbeddedOnesOfTheSameName) {
  const test::TemporaryFolder folder;
  const ShaderLibrary library(folder.path());
  const std::string embedded = ShaderLibrary().text("lib/dct.glsl");
  EXPECT_EQ(library.text("lib/dct.glsl"), embedded) << "the folder has no such file yet";
  std::filesystem::create_directory(folder / "lib");
  std::ofstream(folder / "lib/dct.glsl") << "changed\n";
  EXPECT_EQ(library.text("lib/dct.glsl"), "changed\n") << "read anew with every call";
  EXPECT_EQ(ShaderLibrary().text("lib/dct.glsl"), embedded);
  EXPECT_EQ(expandShader("render/mesh.frag", {}, library).files, expandShader("render/mesh.frag", {}).files);
}

TEST(ShaderSource, EveryShaderFileOfTheSourceTreeIsEmbeddedUnchanged) {
  const std::filesystem::path root = std::filesystem::path(JALOUSIE_SOURCE_DIR) / "shaders";
  std::size_t found = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file() || entry.path().filename() == "CMakeLists.txt") continue;
    const std::string name = entry.path().lexically_relative(root).generic_string();
    const auto shaders = embeddedShaders();
    const auto shader = std::find_if(shaders.begin(), shaders.end(), [&](const auto& s) { return s.name == name; });
    ASSERT_NE(shader, shaders.end()) << name << " is missing from shaders/CMakeLists.txt";
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    EXPECT_EQ(shader->text, text.str()) << name;
    ++found;
  }
  EXPECT_EQ(found, embeddedShaders().size());
}

}  // namespace
}  // namespace jalousie::gl
