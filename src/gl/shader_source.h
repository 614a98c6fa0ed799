// Shader texts: embedded at build time, includes expanded, defines inserted.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jalousie::gl {

/// One file of shaders/, as it was when the program was built.
struct EmbeddedShader {
  std::string_view name;  ///< path below shaders/, e.g. "visibility/classify.comp"
  std::string_view text;
};

/// From now on files of this folder stand in for the embedded ones of the same name, where they exist; empty: the
/// embedded ones again. For development.
void setShaderFolder(const std::filesystem::path& folder);

/// All shader files, in the order of shaders/CMakeLists.txt.
std::span<const EmbeddedShader> embeddedShaders();

/// A text ready for the compiler, and the files its #line directives count.
struct ExpandedShader {
  std::string text;
  std::vector<std::string> files;  ///< source string number -> name, for reading a compiler's log
};

/// Expands `#include "name"` once per file, keeps line numbers with #line, and puts `#define NAME 1` for every define
/// behind #version. Errors: kShader (unknown file, no #version in the first file).
ExpandedShader expandShader(std::string_view name, std::span<const std::string_view> defines);

}  // namespace jalousie::gl
