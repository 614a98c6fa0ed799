// One step of a damped controller on the logarithm of the price.
#include "visibility/price_control.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace jalousie::visibility {

gpu::PriceState firstPrice() {
  return {0.0F, gpu::kMostGain, 0.0F, 0};
}

gpu::PriceState adjustPrice(gpu::PriceState price, const FrameCounters& counters, const gpu::CullView& view) {
  JAL_CHECK(view.triangleBudget > 0U);
  float triangles = 0.0F;
  for (gpu::uint limb = 4; limb-- > 0;)
    triangles = triangles * 1024.0F + static_cast<float>(counters[gpu::kCounterTriangles + limb]);
  const float error = std::log(std::max(triangles, 1.0F) / static_cast<float>(view.triangleBudget));
  const float most = view.calm != 0 ? gpu::kMostCalmGain : gpu::kMostGain;
  float gain = std::min(price.gain, most);
  if (std::abs(error) - std::abs(price.lastError) > gpu::kBudgetJump)
    gain = most;
  else if (error * price.lastError < 0.0F)
    gain = std::max(0.5F * gain, 0.5F * gpu::kLeastGain);
  else if (error > gpu::kBudgetTolerance || error < price.lastError - gpu::kBudgetTolerance)
    gain = std::min(gpu::kGainGrowth * gain, most);
  const bool atRest = std::abs(error) <= gpu::kBudgetTolerance || (error < 0.0F && gain <= gpu::kLeastGain);
  if (!atRest) {
    const float step = std::clamp(gain * error, -gpu::kMostLogStep, gpu::kMostLogStep);
    price.logFactor = std::clamp(price.logFactor + step, -gpu::kMostLogFactor, gpu::kMostLogFactor);
  }
  price.gain = gain;
  price.lastError = error;
  return price;
}

float priceFactor(const gpu::PriceState& price, const gpu::CullView& view) {
  return view.triangleBudget > 0 ? std::exp(price.logFactor) : 1.0F;
}

}  // namespace jalousie::visibility
