// What the user can ask for by key or button, once: the keys, the help window and the buttons read this table.
#pragma once

#include <span>

namespace jalousie::app {

enum class Action {
  kHelp,
  kPanel,
  kGraph,
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
  kPlay,
  kRecord,
  kScreenshot,
  kScreenshotInterface,
  kCopyCommand,
  kDeselect,
  kClose,
  kQuit,
};

struct Binding {
  Action action;
  int key;           ///< GLFW's
  int mods;          ///< GLFW's, exactly these
  const char* keys;  ///< for people
  const char* what;  ///< what it does
};

/// All of them, in the order of the help window.
std::span<const Binding> bindings();

/// What the pointer and the keys that are held do: name and effect.
struct PointerHelp {
  const char* how;
  const char* what;
};
std::span<const PointerHelp> pointerHelp();

}  // namespace jalousie::app
