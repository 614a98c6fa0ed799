// The icon of the window, decoded once when the window opens.
#include "app/view/icon.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>

#include "asset/image_io.h"

namespace jalousie::app {

void setWindowIcon(GLFWwindow* window) {
  constexpr std::uint32_t kMostPixels = 256;
  ImageRgba8 image = asset::decodeImage(embeddedIcon(), {.maxSide = kMostPixels});
  const GLFWimage icon{static_cast<int>(image.width), static_cast<int>(image.height), image.pixels.data()};
  glfwSetWindowIcon(window, 1, &icon);
}

}  // namespace jalousie::app
