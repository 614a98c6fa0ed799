// Opens an EGL context without a surface. libepoxy aborts on eglGetPlatformDisplay before a display exists, so the EXT
// entry point is called instead.
#include "platform/headless_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <cstring>

#include "core/error.h"

namespace jalousie::platform {

/// The display and context. The constructor tries several displays, so either may be absent.
struct HeadlessContext::Egl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  Egl() = default;
  Egl(const Egl&) = delete;
  Egl& operator=(const Egl&) = delete;
  ~Egl() { close(); }

  void close() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
    display = EGL_NO_DISPLAY;
    context = EGL_NO_CONTEXT;
  }

  /// Returns an empty string on success, else what failed.
  std::string open(EGLDisplay candidate, bool debug) {
    if (candidate == EGL_NO_DISPLAY) return "no display";
    EGLint major = 0;
    EGLint minor = 0;
    if (eglInitialize(candidate, &major, &minor) != EGL_TRUE)
      return fmt::format("eglInitialize: 0x{:04x}", eglGetError());
    display = candidate;
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return "no desktop OpenGL";
    const std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                              4,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              5,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_CONTEXT_OPENGL_DEBUG,
                                              debug ? EGL_TRUE : EGL_FALSE,
                                              EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) return fmt::format("no OpenGL 4.5 core context: 0x{:04x}", eglGetError());
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE)
      return fmt::format("eglMakeCurrent: 0x{:04x}", eglGetError());
    return {};
  }
};

namespace {

bool clientHas(const char* extension) {
  const char* all = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return all != nullptr && std::strstr(all, extension) != nullptr;
}

}  // namespace

HeadlessContext::HeadlessContext(bool debug) : egl_(std::make_unique<Egl>()) {
  std::string reason = "EGL offers neither the surfaceless nor the device platform";
  if (clientHas("EGL_MESA_platform_surfaceless")) {
    reason = egl_->open(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), debug);
  }
  if (!reason.empty() && clientHas("EGL_EXT_platform_device") && clientHas("EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices = {};
    EGLint count = 0;
    eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count && !reason.empty(); ++i) {
      egl_->close();
      reason = egl_->open(
          eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr), debug);
    }
  }
  if (!reason.empty()) {
    throw Error(ErrorCode::kNoGpu, fmt::format("cannot open a headless OpenGL 4.5 context ({}); "
                                               "install a driver, on Debian libegl-mesa0 and libgl1-mesa-dri",
                                               reason));
  }
  capabilities_ = gl::queryCapabilities();
}

HeadlessContext::~HeadlessContext() = default;

}  // namespace jalousie::platform
