// An OpenGL 4.5 core context without window or display server, through EGL.
#pragma once

#include <memory>

#include "gl/capabilities.h"

namespace jalousie::platform {

/// The constructor makes a context current, the destructor destroys it. The context has no default framebuffer.
/// Tries Mesa's surfaceless platform first, then the first EGL device that works (NVIDIA).
class HeadlessContext {
 public:
  /// @param debug  make a debug context, whose messages gl::DebugLog collects
  /// Errors: kNoGpu with the reason.
  explicit HeadlessContext(bool debug);
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  const gl::Capabilities& capabilities() const { return capabilities_; }

 private:
  struct Egl;
  std::unique_ptr<Egl> egl_;
  gl::Capabilities capabilities_;
};

}  // namespace jalousie::platform
