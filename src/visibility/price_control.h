// Moves the price of a triangle from frame to frame so that frames stay within a budget of triangles. Plain CPU twin of
// shaders/visibility/adjust_price.comp.
#pragma once

#include "shared/frame_structs.h"
#include "visibility/frame_counters.h"

namespace jalousie::visibility {

/// Before the first frame: the price is that of tau.
gpu::PriceState firstPrice();

/// The state after a frame. Triangles above the budget raise the price, triangles below it lower the price. Within
/// kBudgetTolerance, and below the budget where the levels allow nothing closer, the price stays.
/// @param counters  of the frame   @pre view.triangleBudget > 0 (checked)
gpu::PriceState adjustPrice(gpu::PriceState price, const FrameCounters& counters, const gpu::CullView& view);

/// Factor of kTrianglePrice; 1 without a budget.
float priceFactor(const gpu::PriceState& price, const gpu::CullView& view);

}  // namespace jalousie::visibility
