// What the current context is and can do.
#pragma once

#include <string>

namespace jalousie::gl {

/// Facts of the current context. Only core 4.5 is required.
struct Capabilities {
  std::string renderer;           ///< GL_RENDERER, named beside every figure
  std::string version;            ///< GL_VERSION
  bool softwareRenderer = false;  ///< llvmpipe and friends: timer queries mislead, so passes are timed by glFinish
};

/// Reads the current context. Errors: kNoGpu below OpenGL 4.5.
Capabilities queryCapabilities();

}  // namespace jalousie::gl
