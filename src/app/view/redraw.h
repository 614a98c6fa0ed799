// Counts what is still to be drawn, so that the viewer can wait for events when nothing changes.
#pragma once

#include <algorithm>
#include <cstdint>

#include "app/view/view_state.h"

namespace jalousie::app {

/// Frames that are still needed after a change: of the scenes, of the interface, and the inspection of the selection.
class Redraw {
 public:
  /// @param state  read when scenes change; must outlive this
  explicit Redraw(const ViewState& state) : state_(state) {}

  /// A camera, an option or a file changed: renders the scenes until their visible sets and LODs have settled, draws
  /// the interface, and inspects the selected object again.
  void scenesChanged();
  /// Draws the interface at least this many times before the viewer waits. Dear ImGui needs more than one frame to lay
  /// out a window.
  void interfaceChanged(std::uint32_t frames = 3) { interfaceFrames_ = std::max(interfaceFrames_, frames); }
  /// The selected object is to be inspected again once the scenes have settled.
  void inspectionOutdated() { inspectionOutdated_ = true; }

  void sceneFrameDone() { sceneFrames_ -= sceneFrames_ > 0 ? 1 : 0; }
  void interfaceFrameDone() { interfaceFrames_ -= interfaceFrames_ > 0 ? 1 : 0; }
  void inspectionDone() { inspectionOutdated_ = false; }

  bool needsScenes() const { return sceneFrames_ > 0; }
  bool needsInterface() const { return interfaceFrames_ > 0; }
  bool needsInspection() const { return inspectionOutdated_; }

 private:
  const ViewState& state_;
  std::uint32_t sceneFrames_ = 0;
  std::uint32_t interfaceFrames_ = 3;
  bool inspectionOutdated_ = false;
};

}  // namespace jalousie::app
