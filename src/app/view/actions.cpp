// The tables.
#include "app/view/actions.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>

namespace jalousie::app {

std::span<const Binding> bindings() {
  static constexpr Binding kBindings[] = {
      {Action::kHelp, GLFW_KEY_F1, 0, "F1", "this list"},
      {Action::kPanel, GLFW_KEY_TAB, 0, "Tab", "show or hide the panel"},
      {Action::kGraph, GLFW_KEY_G, 0, "G", "show or hide the frame graph"},
      {Action::kFrame, GLFW_KEY_F, 0, "F", "frame the selected object, or the whole scene"},
      {Action::kReset, GLFW_KEY_R, 0, "R", "the camera of the start"},
      {Action::kFreeze, GLFW_KEY_C, 0, "C", "freeze the culling camera here, or let it go"},
      {Action::kNextView, GLFW_KEY_V, 0, "V", "next view"},
      {Action::kPreviousView, GLFW_KEY_V, GLFW_MOD_SHIFT, "Shift+V", "previous view"},
      {Action::kNextMode, GLFW_KEY_M, 0, "M", "next culling mode"},
      {Action::kMapCoarser, GLFW_KEY_RIGHT_BRACKET, 0, "]", "coarser level of the map"},
      {Action::kMapFiner, GLFW_KEY_LEFT_BRACKET, 0, "[", "finer level of the map"},
      {Action::kBoxes, GLFW_KEY_O, 0, "O", "rectangles (AABR) of all objects"},
      {Action::kSplit, GLFW_KEY_B, 0, "B", "a second configuration right of a divider"},
      {Action::kFlicker, GLFW_KEY_X, 0, "X", "flicker between both configurations"},
      {Action::kPlay, GLFW_KEY_SPACE, 0, "Space", "play or halt the camera path"},
      {Action::kRecord, GLFW_KEY_R, GLFW_MOD_CONTROL, "Ctrl+R", "record the camera, or stop and save the path"},
      {Action::kScreenshot, GLFW_KEY_F12, 0, "F12", "screenshot of the picture"},
      {Action::kScreenshotInterface, GLFW_KEY_F12, GLFW_MOD_SHIFT, "Shift+F12", "screenshot with the interface"},
      {Action::kCopyCommand, GLFW_KEY_C, GLFW_MOD_CONTROL, "Ctrl+C", "copy the command line of this picture"},
      {Action::kDeselect, GLFW_KEY_ESCAPE, 0, "Escape", "select nothing"},
      {Action::kClose, GLFW_KEY_W, GLFW_MOD_CONTROL, "Ctrl+W", "close the current file"},
      {Action::kQuit, GLFW_KEY_Q, GLFW_MOD_CONTROL, "Ctrl+Q", "leave"},
  };
  return kBindings;
}

std::span<const PointerHelp> pointerHelp() {
  static constexpr PointerHelp kHelp[] = {
      {"left drag", "turn around the target"},
      {"middle drag, Shift+left drag", "move across the picture"},
      {"wheel", "nearer, farther"},
      {"right drag", "look around"},
      {"W A S D, Q E", "fly: forward, left, back, right, down, up"},
      {"wheel while flying", "faster, slower"},
      {"click", "select and inspect an object"},
      {"Ctrl+1 .. Ctrl+9", "set a bookmark"},
      {"1 .. 9", "go to a bookmark"},
  };
  return kHelp;
}

}  // namespace jalousie::app
