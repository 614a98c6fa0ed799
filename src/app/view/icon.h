// The program's icon, for the window.
#pragma once

#include <cstddef>
#include <span>

struct GLFWwindow;

namespace jalousie::app {

/// PNG, 64 pixels a side; the build makes it of assets/desktop/jalousie.svg.
std::span<const std::byte> embeddedIcon();

/// glfwSetWindowIcon. Errors: as asset::decodeImage.
void setWindowIcon(GLFWwindow* window);

}  // namespace jalousie::app
