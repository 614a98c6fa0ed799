// GLFW window and context creation.
#include "platform/window.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>

#include "core/error.h"

namespace jalousie::platform {
namespace {

[[noreturn]] void fail(const std::string& what) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  const std::string text = what + (reason != nullptr ? std::string(": ") + reason : "");
  glfwTerminate();
  throw Error(ErrorCode::kNoGpu, text + "; without a display use jalousie render");
}

}  // namespace

Window::Window(const WindowOptions& options) {
  if (glfwInit() != GLFW_TRUE) fail("cannot reach a display");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
  // Desktops find the desktop entry of the program by this name.
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "jalousie");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "jalousie");
  window_ = glfwCreateWindow(static_cast<int>(options.width), static_cast<int>(options.height), options.title.c_str(),
                             nullptr, nullptr);
  if (window_ == nullptr) fail("cannot open a window with OpenGL 4.5");
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(options.waitsForDisplay ? 1 : 0);
  try {
    capabilities_ = gl::queryCapabilities();
  } catch (...) {
    glfwTerminate();
    throw;
  }
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::shouldClose() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::framebufferSize(std::uint32_t& width, std::uint32_t& height) const {
  int w = 0;
  int h = 0;
  glfwGetFramebufferSize(window_, &w, &h);
  width = static_cast<std::uint32_t>(w);
  height = static_cast<std::uint32_t>(h);
}

}  // namespace jalousie::platform
