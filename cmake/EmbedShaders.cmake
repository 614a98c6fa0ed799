# cmake -DOUTPUT=FILE -DROOT=DIR -DNAMES="a;b" -P EmbedShaders.cmake
# Writes a C++ file that defines jalousie::gl::embeddedShaders(): every shader's name and text.

set(text "// Generated from shaders/: names and texts of all shader files.\n#include \"gl/shader_source.h\"\n\n")
string(APPEND text "namespace jalousie::gl {\n\nstd::span<const EmbeddedShader> embeddedShaders() {\n")
string(APPEND text "  static const EmbeddedShader shaders[] = {\n")
foreach(name IN LISTS NAMES)
  file(READ "${ROOT}/${name}" source)
  string(APPEND text "      {\"${name}\", R\"GLSL(${source})GLSL\"},\n")
endforeach()
string(APPEND text "  };\n  return shaders;\n}\n\n}  // namespace jalousie::gl\n")
file(WRITE "${OUTPUT}" "${text}")
