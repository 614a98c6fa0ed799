// Events of a window in their order, so that a key pressed and released between two slow frames is not lost.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

struct GLFWwindow;

namespace jalousie::app {

struct InputEvent {
  enum class Kind { kKey, kButton, kMove, kWheel, kDrop, kFocusLost };
  Kind kind = Kind::kMove;
  int code = 0;          ///< GLFW key or button
  bool pressed = false;  ///< key or button went down; a held key gives one event
  int mods = 0;          ///< GLFW modifiers
  glm::vec2 at{0.0F};    ///< pointer in pixels of the framebuffer, origin at the upper left; kWheel: steps
  std::vector<std::filesystem::path> files = {};  ///< dropped files and folders
};

/// Collects the events of a window during its own lifetime. Must be constructed before Dear ImGui installs its
/// callbacks, which call the ones installed before. Not movable: the window holds its address.
class Input {
 public:
  explicit Input(GLFWwindow* window);
  ~Input();
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  /// The events since the last call, oldest first.
  std::vector<InputEvent> take();
  /// Whether a key is held down now and the window has the focus.
  bool held(int key) const;

 private:
  static Input& of(GLFWwindow* window);
  void add(const InputEvent& event) { events_.push_back(event); }
  glm::vec2 pointer() const;

  GLFWwindow* window_;
  std::vector<InputEvent> events_;
};

}  // namespace jalousie::app
