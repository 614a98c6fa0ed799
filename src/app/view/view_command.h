// `jalousie view`: scenes in a window.
#pragma once

#include "app/view/view_options.h"

namespace jalousie::app {

/// Runs the viewer until its window is closed. @param options  finished
/// Errors: as Viewer::finish(); kNoGpu without a display, with a message that names the headless command; kInternal
/// with --debug after an OpenGL message of medium or high severity.
void runView(const ViewOptions& options);

}  // namespace jalousie::app
