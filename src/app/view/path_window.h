// The frame slider of a camera path, over the picture.
#pragma once

#include <optional>

#include "app/view/document.h"

namespace jalousie::app {

/// What the user asked for in this frame of the slider.
struct PathWindowResult {
  std::optional<double> frame;  ///< show this frame of the path
  bool toggle = false;          ///< play or pause
};

/// Draws a slider over the frames of the document's path with a button to play it, at the upper edge of the window.
/// Nothing for a document without a path.
PathWindowResult drawPath(const Document& document, bool playing);

}  // namespace jalousie::app
