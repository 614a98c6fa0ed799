// Key bindings of the viewer and their texts.
#include "app/view/actions.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise includes the system's OpenGL header.
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>

namespace jalousie::app {

std::span<const Binding> bindings() {
  static constexpr Binding kBindings[] = {
      {Action::kHelp, GLFW_KEY_F1, 0, "F1", "Show or hide this list"},
      {Action::kPanel, GLFW_KEY_TAB, 0, "Tab", "Show or hide the panel"},
      {Action::kGraph, GLFW_KEY_G, 0, "G", "Show or hide the frame graph"},
      {Action::kObjects, GLFW_KEY_L, 0, "L", "Show or hide the list of objects"},
      {Action::kFrame, GLFW_KEY_F, 0, "F", "Fit the view to the selected object, else to the whole scene"},
      {Action::kReset, GLFW_KEY_R, 0, "R", "Go back to the camera of the start"},
      {Action::kFreeze, GLFW_KEY_C, 0, "C", "Freeze the culling camera here, or let it follow again"},
      {Action::kNextView, GLFW_KEY_V, 0, "V", "Next view"},
      {Action::kPreviousView, GLFW_KEY_V, GLFW_MOD_SHIFT, "Shift+V", "Previous view"},
      {Action::kNextMode, GLFW_KEY_M, 0, "M", "Next culling mode"},
      {Action::kMapCoarser, GLFW_KEY_RIGHT_BRACKET, 0, "]", "Show a coarser level of the occlusion map"},
      {Action::kMapFiner, GLFW_KEY_LEFT_BRACKET, 0, "[", "Show a finer level of the occlusion map"},
      {Action::kBoxes, GLFW_KEY_O, 0, "O", "Show or hide the bounding rectangles (AABR) of all objects"},
      {Action::kHide, GLFW_KEY_H, 0, "H", "Hide the selected object"},
      {Action::kIsolate, GLFW_KEY_I, 0, "I", "Hide all objects but the selected one"},
      {Action::kShowAll, GLFW_KEY_H, GLFW_MOD_SHIFT, "Shift+H", "Show all objects"},
      {Action::kSplit, GLFW_KEY_B, 0, "B", "Show or hide a second configuration right of a divider"},
      {Action::kFlicker, GLFW_KEY_X, 0, "X", "Flicker between both configurations"},
      {Action::kPlay, GLFW_KEY_SPACE, 0, "Space", "Play or pause the camera path"},
      {Action::kNextFrame, GLFW_KEY_RIGHT, 0, "Right", "Next frame of the camera path"},
      {Action::kPreviousFrame, GLFW_KEY_LEFT, 0, "Left", "Previous frame of the camera path"},
      {Action::kRecord, GLFW_KEY_R, GLFW_MOD_CONTROL, "Ctrl+R",
       "Record the camera as a glTF camera animation (30 poses a second), or stop and save it"},
      {Action::kScreenshot, GLFW_KEY_F12, 0, "F12", "Save the picture as jalousie render writes it"},
      {Action::kScreenshotInterface, GLFW_KEY_F12, GLFW_MOD_SHIFT, "Shift+F12", "Save the picture with the interface"},
      {Action::kSaveFrames, GLFW_KEY_G, GLFW_MOD_CONTROL, "Ctrl+G", "Save the frames of the graph as CSV"},
      {Action::kCopyCommand, GLFW_KEY_C, GLFW_MOD_CONTROL, "Ctrl+C",
       "Copy the jalousie render command of configuration A's picture"},
      {Action::kDeselect, GLFW_KEY_ESCAPE, 0, "Escape", "Clear the selection"},
      {Action::kClose, GLFW_KEY_W, GLFW_MOD_CONTROL, "Ctrl+W", "Close the current file"},
      {Action::kQuit, GLFW_KEY_Q, GLFW_MOD_CONTROL, "Ctrl+Q", "Quit"},
  };
  static_assert(std::size(kBindings) == kActionCount, "every action has a key");
  return kBindings;
}

std::string helpText(Action action) {
  const auto all = bindings();
  const auto& binding =
      *std::find_if(all.begin(), all.end(), [&](const Binding& candidate) { return candidate.action == action; });
  return fmt::format("{} ({})", binding.what, binding.keys);
}

std::span<const PointerHelp> pointerHelp() {
  static constexpr PointerHelp kHelp[] = {
      {"Left drag", "Turn the camera around its target"},
      {"Middle drag, Shift+left drag", "Move the camera parallel to the screen"},
      {"Wheel", "Move nearer or farther"},
      {"Right drag", "Look around"},
      {"W A S D, Q E", "Fly forward, left, back, right, down, up"},
      {"Wheel while flying", "Fly faster or slower"},
      {"Click", "Select and inspect an object"},
      {"Ctrl+1 .. Ctrl+9", "Set a bookmark of the camera"},
      {"1 .. 9", "Go to a bookmark"},
  };
  return kHelp;
}

}  // namespace jalousie::app
