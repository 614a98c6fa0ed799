// Dear ImGui in a window: made, begun and drawn once a frame.
#pragma once

#include <string>

struct GLFWwindow;

namespace jalousie::app {

/// One at a time. Keeps nothing on disk.
class Interface {
 public:
  /// @param scale  of everything; 0: the display's   @param layout  as layout() returned it once; may be empty
  Interface(GLFWwindow* window, float scale, const std::string& layout);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  void begin();
  /// Draws into the bound framebuffer.
  void end();
  /// Whether the pointer or the keyboard is busy with the interface.
  bool wantsPointer() const;
  bool wantsKeys() const;
  float scale() const { return scale_; }
  /// Places of the windows, to keep.
  std::string layout() const;

 private:
  float scale_;
};

}  // namespace jalousie::app
