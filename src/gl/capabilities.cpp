// Reads the properties of a context through glGetString and the list of extensions.
#include "gl/capabilities.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "core/error.h"

namespace jalousie::gl {
namespace {

std::string glString(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text != nullptr ? reinterpret_cast<const char*>(text) : "unknown";
}

}  // namespace

Capabilities Capabilities::withoutFastPaths() const {
  Capabilities core = *this;
  core.drawParameters = core.indirectCount = core.minMaxFilter = false;
  return core;
}

Capabilities queryCapabilities() {
  if (epoxy_gl_version() < 45)
    throw Error(ErrorCode::kNoGpu, fmt::format("OpenGL 4.5 is needed, this driver offers '{}'", glString(GL_VERSION)));
  Capabilities result;
  result.renderer = glString(GL_RENDERER);
  result.version = glString(GL_VERSION);
  result.drawParameters = epoxy_has_gl_extension("GL_ARB_shader_draw_parameters");
  result.indirectCount = epoxy_has_gl_extension("GL_ARB_indirect_parameters");
  result.minMaxFilter = epoxy_has_gl_extension("GL_ARB_texture_filter_minmax");
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "SwiftShader"})
    result.softwareRenderer |= result.renderer.find(name) != std::string::npos;
  return result;
}

}  // namespace jalousie::gl
