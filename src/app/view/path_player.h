// Plays the camera paths of the open documents.
#pragma once

#include <cstdint>

#include "app/view/documents.h"
#include "app/view/messages.h"
#include "app/view/redraw.h"
#include "app/view/view_options.h"
#include "app/view/view_state.h"

namespace jalousie::app {

/// Sets the frames of documents while ViewState::playing. A path starts over after its last frame.
class PathPlayer {
 public:
  /// All arguments must outlive this. @param options  a script plays one frame of the path in each of its frames
  PathPlayer(const ViewOptions& options, ViewState& state, Documents& documents, Redraw& redraw, Messages& messages);

  /// Plays from the current frame, or pauses. Says so where the current document has no path.
  void toggle();
  /// Pauses, and shows a frame of the path to the current document and its followers.
  /// @param frame  beyond the path: its first or last one
  void goTo(double frame);
  /// Goes some frames on, back where negative. Says so where the current document has no path.
  void move(int frames);
  /// Advances the current document and its followers, in a script all documents. Fails with a message if no document
  /// has a path. @param seconds  since the last call   @param framesDone  frames of the viewer so far
  void step(double seconds, std::uint32_t framesDone);

 private:
  void show(std::size_t document, double frame);

  const ViewOptions& options_;
  ViewState& state_;
  Documents& documents_;
  Redraw& redraw_;
  Messages& messages_;
  double startSeconds_;  ///< place in the path at the start of the program
  double pathSeconds_;   ///< place in the path now
};

}  // namespace jalousie::app
