// Records the camera of a document as a glTF camera path.
#pragma once

#include "app/view/documents.h"
#include "app/view/messages.h"
#include "app/view/redraw.h"
#include "app/view/view_state.h"
#include "asset/scene_file.h"

namespace jalousie::app {

/// Takes poses while ViewState::recording, at most 30 a second.
class Recorder {
 public:
  /// All arguments must outlive this.
  Recorder(ViewState& state, Documents& documents, Redraw& redraw, Messages& messages);

  /// Starts with the current document, or stops and saves.
  void toggle();
  /// Takes the pose of this moment.
  void step();
  /// Stops and saves, if a recording runs; a failure becomes a message.
  void stop();
  /// Writes the poses so far to a new file; the recorded document and its followers then use that path.
  /// Errors: as savePath.
  void save();

 private:
  ViewState& state_;
  Documents& documents_;
  Redraw& redraw_;
  Messages& messages_;
  const Document* document_ = nullptr;  ///< whose camera is recorded; stays open while recording
  asset::CameraTrack track_;
  double startSeconds_ = 0.0;
};

}  // namespace jalousie::app
