// Events of a window, collected by GLFW callbacks.
#include "app/view/input.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>

#include <utility>

namespace jalousie::app {

Input::Input(GLFWwindow* window) : window_(window) {
  using Kind = InputEvent::Kind;
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int mods) {
    of(w).add({Kind::kKey, key, action == GLFW_PRESS, mods, of(w).pointer()});
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    of(w).add({Kind::kButton, button, action != GLFW_RELEASE, mods, of(w).pointer()});
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) {
    of(w).add({Kind::kMove, 0, false, 0, of(w).pointer()});
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    of(w).add({Kind::kWheel, 0, false, 0, {static_cast<float>(x), static_cast<float>(y)}});
  });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    if (focused != GLFW_TRUE) of(w).add({Kind::kFocusLost});
  });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    InputEvent event{Kind::kDrop};
    event.files.assign(paths, paths + count);
    of(w).add(event);
  });
}

Input::~Input() {
  glfwSetKeyCallback(window_, nullptr);
  glfwSetMouseButtonCallback(window_, nullptr);
  glfwSetCursorPosCallback(window_, nullptr);
  glfwSetScrollCallback(window_, nullptr);
  glfwSetWindowFocusCallback(window_, nullptr);
  glfwSetDropCallback(window_, nullptr);
}

Input& Input::of(GLFWwindow* window) {
  return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

std::vector<InputEvent> Input::take() {
  return std::exchange(events_, {});
}

bool Input::held(int key) const {
  return glfwGetWindowAttrib(window_, GLFW_FOCUSED) == GLFW_TRUE && glfwGetKey(window_, key) == GLFW_PRESS;
}

glm::vec2 Input::pointer() const {
  double x = 0.0;
  double y = 0.0;
  int width = 1;
  int height = 1;
  int pixelsX = 1;
  int pixelsY = 1;
  glfwGetCursorPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  glfwGetFramebufferSize(window_, &pixelsX, &pixelsY);
  if (width < 1 || height < 1) return {0.0F, 0.0F};
  return {static_cast<float>(x) * static_cast<float>(pixelsX) / static_cast<float>(width),
          static_cast<float>(y) * static_cast<float>(pixelsY) / static_cast<float>(height)};
}

}  // namespace jalousie::app
