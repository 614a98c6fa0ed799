// Time as the viewer measures it.
#pragma once

namespace jalousie::app {

/// Seconds since GLFW was initialised: glfwGetTime.
double secondsNow();

}  // namespace jalousie::app
