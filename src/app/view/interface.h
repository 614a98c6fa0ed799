// Dear ImGui in a window: set up once, begun and drawn once per frame.
#pragma once

#include <string>

struct GLFWwindow;

namespace jalousie::app {

/// Only one may exist at a time. Writes no files. Coordinates are pixels of the framebuffer, whatever the screen
/// coordinates of the window are.
class Interface {
 public:
  /// @param scale   of all widgets; 0: that of the display, also after the window moves to another display
  /// @param layout  from layout(), for the positions of the windows; may be empty
  /// Errors: kShader if the programs of the interface do not build.
  Interface(GLFWwindow* window, float scale, const std::string& layout);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Begins a frame; widgets may be declared from now on.
  void begin();
  /// Ends the frame and draws it into the bound framebuffer.
  void end();
  /// Whether pointer or key events belong to the interface.
  bool wantsPointer() const;
  bool wantsKeys() const;
  float scale() const { return scale_; }
  /// Positions and sizes of the windows, as text to be stored.
  std::string layout() const;

 private:
  void useScale(float scale);

  GLFWwindow* window_;
  bool followsDisplay_;
  float scale_ = 0.0F;  ///< 0 until it is set
};

}  // namespace jalousie::app
