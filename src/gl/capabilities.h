// What the current context is and can do.
#pragma once

#include <string>

namespace jalousie::gl {

/// Facts of the current context. Only core 4.5 is required; extensions are fast paths that give the same results.
struct Capabilities {
  std::string renderer;           ///< GL_RENDERER, named beside every figure
  std::string version;            ///< GL_VERSION
  bool softwareRenderer = false;  ///< llvmpipe and friends: timer queries mislead, so passes are timed by glFinish
  bool drawParameters = false;    ///< ARB_shader_draw_parameters: instance lists are read in the shader
  bool indirectCount = false;     ///< ARB_indirect_parameters: the number of draws comes from a buffer
  bool minMaxFilter = false;      ///< ARB_texture_filter_minmax: four texels reduced by one fetch

  /// The same driver as if it had core 4.5 only.
  Capabilities withoutFastPaths() const;
};

/// Reads the current context. Errors: kNoGpu below OpenGL 4.5.
Capabilities queryCapabilities();

}  // namespace jalousie::gl
