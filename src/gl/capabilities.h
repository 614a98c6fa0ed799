// Properties and optional features of the current OpenGL context.
#pragma once

#include <string>

namespace jalousie::gl {

/// Properties of a context. Only OpenGL 4.5 core is required; extensions are fast paths that give the same results.
struct Capabilities {
  std::string renderer;           ///< GL_RENDERER, printed with every measurement
  std::string version;            ///< GL_VERSION
  bool softwareRenderer = false;  ///< llvmpipe or alike: its timer queries are wrong, use Timing::kWall
  bool drawParameters = false;    ///< ARB_shader_draw_parameters: instance lists are read in the shader
  bool indirectCount = false;     ///< ARB_indirect_parameters: the number of draws comes from a buffer
  bool minMaxFilter = false;      ///< ARB_texture_filter_minmax: four texels reduced by one fetch

  /// These capabilities without the extensions.
  Capabilities withoutFastPaths() const;
};

/// Reads the current context. Errors: kNoGpu below OpenGL 4.5.
Capabilities queryCapabilities();

}  // namespace jalousie::gl
