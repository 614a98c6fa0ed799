// `jalousie render`: one frame of a scene, headless, as a PNG and as figures.
#pragma once

#include "app/render_options.h"

namespace jalousie::app {

/// Loads, renders, writes. @param options  finished. Errors: as the loaders, kNoGpu, kShader, kWriteFailed.
void runRender(const RenderOptions& options);

}  // namespace jalousie::app
