// Events of a window, in the order they came: a key that is pressed and released between two slow frames is not lost.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

struct GLFWwindow;

namespace jalousie::app {

struct InputEvent {
  enum class Kind { kKey, kButton, kMove, kWheel, kDrop, kFocusLost };
  Kind kind = Kind::kMove;
  int code = 0;          ///< GLFW's key or button
  bool pressed = false;  ///< of a key or button; a key that is held down is pressed once
  int mods = 0;          ///< GLFW's modifiers
  glm::vec2 at{0.0F};    ///< pointer in pixels of the framebuffer, origin at the upper left; the wheel's steps
  std::vector<std::filesystem::path> files = {};  ///< dropped
};

/// Collects the events of a window while it lives; make it before the interface library installs its own callbacks,
/// which call these. Not movable: the window holds its address.
class Input {
 public:
  explicit Input(GLFWwindow* window);
  ~Input();
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  /// The events since the last call.
  std::vector<InputEvent> take();
  /// Whether a key is held down now.
  bool held(int key) const;

 private:
  static Input& of(GLFWwindow* window);
  void add(const InputEvent& event) { events_.push_back(event); }
  glm::vec2 pointer() const;

  GLFWwindow* window_;
  std::vector<InputEvent> events_;
};

}  // namespace jalousie::app
