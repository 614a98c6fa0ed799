// Linked shader programs.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "gl/handle.h"
#include "gl/shader_source.h"

namespace jalousie::gl {

/// Sources of a program: shader files, whose extensions name the stages, and preprocessor defines for all of them.
struct ProgramSource {
  const char* name;
  std::vector<std::string_view> stages;
  std::vector<std::string_view> defines;
};

/// The same program with one more define.
ProgramSource withDefine(ProgramSource source, std::string_view define);

/// A linked program. It has no uniforms to set: all input comes from buffers, textures and fixed bindings.
class Program {
 public:
  Program() = default;
  /// glCreateShader, glCompileShader, glLinkProgram. Errors: kShader with the driver's log and the file names that its
  /// numbers mean; those of ShaderLibrary::text.
  explicit Program(const ProgramSource& source, const ShaderLibrary& library = {});

  GLuint id() const { return handle_.id(); }
  /// glUseProgram.
  void use() const { glUseProgram(id()); }

 private:
  Handle<ProgramTraits> handle_;
};

}  // namespace jalousie::gl
