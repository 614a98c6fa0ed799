// The window of the frame graph.
#pragma once

#include "app/view/frame_history.h"

namespace jalousie::app {

/// Draws time per pass, triangles, and drawn and culled objects over the last seconds.
/// @return  whether the user wants the frames as a file
bool drawFrameGraph(const FrameHistory& history);

}  // namespace jalousie::app
