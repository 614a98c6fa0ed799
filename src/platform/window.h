// A window with an OpenGL 4.5 core context, through GLFW.
#pragma once

#include <cstdint>
#include <string>

#include "gl/capabilities.h"

struct GLFWwindow;

namespace jalousie::platform {

struct WindowOptions {
  std::uint32_t width = 1280;  ///< screen coordinates
  std::uint32_t height = 720;
  std::string title = "jalousie";
  bool debug = false;            ///< makes a debug context, whose messages gl::DebugLog collects
  bool waitsForDisplay = false;  ///< glfwSwapInterval(1): swapping waits for the display's next refresh
};

/// Opens a window and makes its context current; closes it when destroyed. One at a time, on the main thread.
class Window {
 public:
  /// Errors: kNoGpu (no display, or no OpenGL 4.5) with the reason; the message names `jalousie render`, which
  /// needs no display.
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// For GLFW calls of an interface: events, clipboard, glfwSwapBuffers. Owned by this object.
  GLFWwindow* handle() const { return window_; }
  const gl::Capabilities& capabilities() const { return capabilities_; }
  /// glfwWindowShouldClose.
  bool shouldClose() const;
  /// Framebuffer size in pixels; 0 x 0 while minimised.
  void framebufferSize(std::uint32_t& width, std::uint32_t& height) const;

 private:
  GLFWwindow* window_ = nullptr;
  gl::Capabilities capabilities_;
};

}  // namespace jalousie::platform
