// `jalousie view`: scenes in a window.
#pragma once

#include "app/view/view_options.h"

namespace jalousie::app {

/// Runs the viewer until its window is closed. A signal closes the window as its user does; a script (--frames or
/// --screenshot) ends at once and writes nothing. @param options  finished   @return  exit code
/// Errors: as Viewer::finish(); kNoGpu without a display, with a message that names the headless command; kInternal
/// with --debug after an OpenGL message of medium or high severity.
int runView(const ViewOptions& options);

}  // namespace jalousie::app
