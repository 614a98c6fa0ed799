// Moves the price of a triangle from frame to frame so that frames stay within a budget of triangles. Plain CPU twin of
// shaders/visibility/adjust_price.comp.
#pragma once

#include "shared/frame_structs.h"

namespace jalousie::visibility {

/// Before the first frame: the price is that of tau.
gpu::PriceState firstPrice();

/// The state after a frame. Triangles above the budget raise the price, triangles below it lower the price. Within
/// kBudgetTolerance, and below the budget where the levels allow nothing closer, the price stays. Calm levels have a
/// margin in which they stay; first its end that changes levels in the right direction moves. Otherwise, where a frame
/// rests below the budget because the next step of one object is too large, levels that add few triangles become finer.
/// @param triangles  at the present price, without levels that fade out: those of budgetSum at kBudgetWanted
/// @pre view.triangleBudget > 0 (checked)
gpu::PriceState adjustPrice(gpu::PriceState price, float triangles, const gpu::CullView& view);

/// Factor of kTrianglePrice; 1 without a budget. @param margin  that scales tau: below 1 the fine end of the calm
/// margin, above 1 the coarse end
float priceFactor(const gpu::PriceState& price, const gpu::CullView& view, float margin = 1.0F);

/// Without calm levels: whether a finer level has the lower price exp(logCoarse) if it adds few triangles.
bool pricesSmallSteps(const gpu::PriceState& price, const gpu::CullView& view);
/// Whether the step from one level to the next finer ones adds at most kBudgetSmallStep of the budget.
/// @param fewer, more  triangles
bool isSmallStep(gpu::uint fewer, gpu::uint more, const gpu::CullView& view);

}  // namespace jalousie::visibility
