// The icon of the window.
#pragma once

#include <cstddef>
#include <span>

struct GLFWwindow;

namespace jalousie::app {

/// PNG of 64 x 64 pixels, which the build makes from assets/desktop/jalousie.svg.
std::span<const std::byte> embeddedIcon();

/// Sets the icon of a window: glfwSetWindowIcon. Errors: as asset::decodeImage.
void setWindowIcon(GLFWwindow* window);

}  // namespace jalousie::app
