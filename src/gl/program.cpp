// Compiles and links programs. An error carries the log of the driver and the file names that its numbers mean.
#include "gl/program.h"

#include <fmt/format.h>

#include "core/error.h"

namespace jalousie::gl {
namespace {

GLenum stageOf(std::string_view file) {
  const std::string_view extension = file.substr(file.rfind('.') + 1);
  if (extension == "vert") return GL_VERTEX_SHADER;
  if (extension == "tesc") return GL_TESS_CONTROL_SHADER;
  if (extension == "tese") return GL_TESS_EVALUATION_SHADER;
  if (extension == "geom") return GL_GEOMETRY_SHADER;
  if (extension == "frag") return GL_FRAGMENT_SHADER;
  if (extension == "comp") return GL_COMPUTE_SHADER;
  throw Error(ErrorCode::kShader, fmt::format("shader '{}' has no known stage extension", file));
}

std::string shaderLog(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  if (length > 0) glGetShaderInfoLog(shader, length, nullptr, log.data());
  return log;
}

std::string programLog(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  if (length > 0) glGetProgramInfoLog(program, length, nullptr, log.data());
  return log;
}

std::string fileLegend(const ExpandedShader& source) {
  std::string legend;
  for (std::size_t i = 0; i < source.files.size(); ++i)
    legend += fmt::format("{}{} = {}", i == 0 ? "" : ", ", i, source.files[i]);
  return legend;
}

Handle<ShaderTraits> compile(std::string_view file, const std::vector<std::string_view>& defines,
                             const ShaderLibrary& library) {
  const ExpandedShader source = expandShader(file, defines, library);
  Handle<ShaderTraits> shader(glCreateShader(stageOf(file)));
  const char* text = source.text.c_str();
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled != GL_TRUE)
    throw Error(ErrorCode::kShader,
                fmt::format("does not compile: {} ({})", shaderLog(shader.id()), fileLegend(source)), file);
  return shader;
}

}  // namespace

ProgramSource withDefine(ProgramSource source, std::string_view define) {
  source.defines.push_back(define);
  return source;
}

Program::Program(const ProgramSource& source, const ShaderLibrary& library) : handle_(glCreateProgram()) {
  label(GL_PROGRAM, id(), source.name);
  std::vector<Handle<ShaderTraits>> shaders;
  for (const std::string_view stage : source.stages) {
    shaders.push_back(compile(stage, source.defines, library));
    glAttachShader(id(), shaders.back().id());
  }
  glLinkProgram(id());
  GLint linked = GL_FALSE;
  glGetProgramiv(id(), GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE)
    throw Error(ErrorCode::kShader, fmt::format("program does not link: {}", programLog(id())), source.name);
  for (const Handle<ShaderTraits>& shader : shaders)
    glDetachShader(id(), shader.id());
}

}  // namespace jalousie::gl
