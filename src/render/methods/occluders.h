// Drawing occluders into the occlusion map, for the methods that use one.
#pragma once

#include "render/methods/frame_context.h"

namespace jalousie::render {

/// Whether occluders are drawn with a depth test, so that their depth is known.
enum class OccluderDepth { kIgnored, kTested };

/// Draws the early list into level 0 of the map, and with kTested its depth into the frame's depth.
void drawOccluders(const FrameContext& frame, OccluderDepth depth) noexcept;
/// Reduces the map to its coarsest level.
void reduceMap(const FrameContext& frame) noexcept;

}  // namespace jalousie::render
