// The command line that gives the picture in the window.
#pragma once

#include <string>

#include "app/render_options.h"

namespace jalousie::app {

/// `jalousie render FILE ...` with everything that differs from the defaults, quoted for a shell.
/// @param options  as said, not finished: what finish() fills in is left to it
std::string renderCommand(const RenderOptions& options, const std::string& output);

/// The same options without file, cameras, size and output: what --split and configuration files take.
std::string methodOptions(const RenderOptions& options);

}  // namespace jalousie::app
