// Dear ImGui in a window: made, begun and drawn once a frame.
#pragma once

#include <string>

struct GLFWwindow;

namespace jalousie::app {

/// One at a time. Keeps nothing on disk. Its unit is the pixel of the framebuffer, whatever the window's own is.
class Interface {
 public:
  /// @param scale  of everything; 0: the display's, also when the window moves to another one   @param layout  as
  /// layout() returned it once; may be empty
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
  void useScale(float scale);

  GLFWwindow* window_;
  bool followsDisplay_;
  float scale_ = 0.0F;  ///< not yet
};

}  // namespace jalousie::app
