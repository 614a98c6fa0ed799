// Shader texts: embedded at build time, includes expanded, defines inserted.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace jalousie::gl {

/// One file of shaders/, as it was when the program was built.
struct EmbeddedShader {
  std::string_view name;  ///< path below shaders/, e.g. "visibility/classify.comp"
  std::string_view text;
};

/// All shader files, in the order of shaders/CMakeLists.txt.
std::span<const EmbeddedShader> embeddedShaders();

/// Where shader texts come from: a folder, for development, and the embedded files.
class ShaderLibrary {
 public:
  /// The embedded files alone.
  ShaderLibrary() = default;
  /// Files below the folder replace the embedded files of the same name where they exist. Nothing is read yet.
  /// @param folder  empty: the embedded files alone
  explicit ShaderLibrary(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The file as it is now. Errors: kShader (no such file), those of readFile().
  /// @param name  path below shaders/, e.g. "visibility/classify.comp"
  std::string text(std::string_view name) const;

 private:
  std::filesystem::path folder_;
};

/// A text ready for the compiler, and the files that its #line directives number.
struct ExpandedShader {
  std::string text;
  std::vector<std::string> files;  ///< source string number -> name, for reading a compiler's log
};

/// Expands `#include "name"` once per file, keeps line numbers with #line, and puts every define behind #version: NAME
/// as `#define NAME 1`, NAME=VALUE as `#define NAME VALUE`. Errors: kShader (unknown file, no #version in the first
/// file).
ExpandedShader expandShader(std::string_view name, std::span<const std::string_view> defines,
                            const ShaderLibrary& library = {});

}  // namespace jalousie::gl
