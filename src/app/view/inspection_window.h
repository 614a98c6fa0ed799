// The window of the selected object.
#pragma once

#include "app/render_options.h"
#include "app/view/inspection.h"

namespace jalousie::app {

/// Draws what was found out about an object: verdict, AABR, LV and budget, its block and spectrum, its LODs.
/// @param options  of the inspected picture
/// @return  width of the window in pixels if it is at the right edge, else 0
float drawInspection(const Inspection& inspection, const RenderOptions& options);

}  // namespace jalousie::app
