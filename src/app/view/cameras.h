// Cameras of the current document: its pose, framing, freezing, and bookmarks.
#pragma once

#include <cstddef>

#include "app/view/documents.h"
#include "app/view/messages.h"
#include "app/view/pose.h"
#include "app/view/redraw.h"
#include "app/view/view_state.h"

namespace jalousie::app {

/// Every change applies to the current document; documents that share its camera follow. Without a document, nothing
/// happens, unless a function says otherwise.
class Cameras {
 public:
  /// All arguments must outlive this.
  Cameras(ViewState& state, Documents& documents, Redraw& redraw, Messages& messages);

  /// Pose of the drawing camera. @pre a document is open
  Pose pose();
  /// Ends playing and moves the camera. Does nothing if no camera can have that pose.
  void move(const Pose& pose);
  /// The selected object, else the whole scene, fills the view.
  void frame();
  /// Freezes the culling camera at the drawing camera, or lets it follow again.
  void freezeOrThaw();
  /// @param number  in [0, kBookmarks)   @return whether it was set
  bool setBookmark(std::size_t number);
  void goToBookmark(std::size_t number);

 private:
  Bookmarks& bookmarks();

  ViewState& state_;
  Documents& documents_;
  Redraw& redraw_;
  Messages& messages_;
};

}  // namespace jalousie::app
