// Time as the viewer measures it: GLFW's monotonic clock.
#include "app/view/clock.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise includes the system's OpenGL header.
#include <GLFW/glfw3.h>

namespace jalousie::app {

double secondsNow() {
  return glfwGetTime();
}

}  // namespace jalousie::app
