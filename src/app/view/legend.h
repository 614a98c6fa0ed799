// Legends: what the colours of a view mean.
#pragma once

#include <cstdint>

#include "app/render_options.h"
#include "app/view/region.h"

namespace jalousie::app {

/// Draws the legend of a view in the lower right corner of a region; nothing for views without colours of their own.
/// @param levelCount  of the scene's longest chain, or of its patches
void drawLegend(const Region& region, const RenderOptions& options, std::uint32_t levelCount);

}  // namespace jalousie::app
