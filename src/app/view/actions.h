// Actions of keys and buttons, and the table of keys that key handling, help window and tooltips read.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace jalousie::app {

enum class Action {
  kHelp,
  kPanel,
  kGraph,
  kObjects,
  kReset,
  kFrame,
  kFreeze,
  kSplit,
  kFlicker,
  kNextView,
  kPreviousView,
  kNextMode,
  kMapCoarser,
  kMapFiner,
  kBoxes,
  kHide,
  kIsolate,
  kShowAll,
  kPlay,
  kRecord,
  kScreenshot,
  kScreenshotInterface,
  kSaveFrames,
  kNextFrame,
  kPreviousFrame,
  kCopyCommand,
  kDeselect,
  kClose,
  kQuit,
};
inline constexpr std::size_t kActionCount = static_cast<std::size_t>(Action::kQuit) + 1;

/// The key of an action.
struct Binding {
  Action action;
  int key;           ///< GLFW key
  int mods;          ///< GLFW modifiers; no others may be held
  const char* keys;  ///< name of the key, for the help window
  const char* what;  ///< what the action does
};

/// One binding per action, in the order of the help window.
std::span<const Binding> bindings();

/// What an action does and its key, for a tooltip: "Go back to the camera of the start (R)".
std::string helpText(Action action);

/// Use of the pointer, and of keys that are held down.
struct PointerHelp {
  const char* how;
  const char* what;
};
/// In the order of the help window.
std::span<const PointerHelp> pointerHelp();

}  // namespace jalousie::app
