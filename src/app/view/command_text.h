// The command line of the picture in the window.
#pragma once

#include <string>

#include "app/render_options.h"

namespace jalousie::app {

/// `jalousie render FILE ...` with all options that differ from the defaults, quoted for a shell.
/// @param options  options as chosen; values that finish() fills in may be missing
std::string renderCommand(const RenderOptions& options, const std::string& output);

/// The options that choose method and view, as --split and configuration files take them. File, cameras, size and
/// output are left out.
std::string methodOptions(const RenderOptions& options);

}  // namespace jalousie::app
