// The window of keys.
#pragma once

namespace jalousie::app {

/// Draws the uses of pointer and keys. @param open  set to false when the user closes the window
void drawHelp(bool* open);

}  // namespace jalousie::app
