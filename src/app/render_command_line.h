// The options of `jalousie render` on a command line.
#pragma once

#include "app/render_options.h"

namespace CLI {
class App;
}

namespace jalousie::app {

/// Declares the options that choose how a frame is culled and detailed, and none of camera and output.
void addMethodOptions(CLI::App& command, RenderOptions& options);

/// Declares the options that choose the cameras and the size of the picture.
void addCameraOptions(CLI::App& command, RenderOptions& options);

/// Declares the options that choose what is looked at.
void addPictureOptions(CLI::App& command, RenderOptions& options);

/// Declares all options on a subcommand; values land in options, which must outlive the parse.
void addRenderOptions(CLI::App& command, RenderOptions& options);

}  // namespace jalousie::app
