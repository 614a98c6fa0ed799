// `jalousie view`: scenes in a window.
#pragma once

#include "app/view/view_options.h"

namespace jalousie::app {

/// Runs until the window is closed. @param options  finished
/// Errors: kNoGpu without a display, naming the headless command; kWriteFailed; kInternal with --debug if
/// OpenGL reported a message.
void runView(const ViewOptions& options);

}  // namespace jalousie::app
