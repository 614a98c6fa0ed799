// Linked shader programs.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "gl/handle.h"

namespace jalousie::gl {

/// What a program is made of: shader files (the extension names the stage) and preprocessor defines for all of them.
struct ProgramSource {
  const char* name;
  std::vector<std::string_view> stages;
  std::vector<std::string_view> defines;
};

/// The same program with one more define.
ProgramSource withDefine(ProgramSource source, std::string_view define);

/// A linked program. Has no uniforms to set: everything comes from buffers, textures and fixed bindings.
class Program {
 public:
  Program() = default;
  /// glCreateShader, glCompileShader, glLinkProgram. Errors: kShader with the driver's log and the file names it
  /// counts.
  explicit Program(const ProgramSource& source);

  GLuint id() const { return handle_.id(); }
  /// glUseProgram.
  void use() const { glUseProgram(id()); }

 private:
  Handle<ProgramTraits> handle_;
};

}  // namespace jalousie::gl
