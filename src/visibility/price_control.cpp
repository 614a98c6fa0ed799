// One step of a damped controller on the logarithm of the price.
#include "visibility/price_control.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "shared/limits.h"

namespace jalousie::visibility {
namespace {

/// Gain of this step. @param error  logarithm of triangles over budget
float gainOf(const gpu::PriceState& price, float error) {
  if (std::abs(error) - std::abs(price.lastError) > gpu::kBudgetJump) return gpu::kMostGain;
  if (error * price.lastError < 0.0F) return std::max(0.5F * price.gain, 0.5F * gpu::kLeastGain);
  const bool stays = error <= gpu::kBudgetTolerance && error >= price.lastError - gpu::kBudgetTolerance;
  return stays ? price.gain : std::min(gpu::kGainGrowth * price.gain, gpu::kMostGain);
}

/// Above the budget the fine end of the margin rises, below it the coarse end falls. Each moves the other one along
/// when the margin has no width left.
void move(gpu::PriceState& price, float step, float widest) {
  if (step > 0.0F) {
    price.logFine = std::clamp(price.logFine + step, -gpu::kMostLogFactor, gpu::kMostLogFactor);
    price.logCoarse = std::max(price.logCoarse, price.logFine - widest);
  } else {
    price.logCoarse = std::clamp(price.logCoarse + step, -gpu::kMostLogFactor, gpu::kMostLogFactor);
    price.logFine = std::min(price.logFine, price.logCoarse + widest);
  }
}

void recover(gpu::PriceState& price, float widest) {
  const float step = std::min(gpu::kMarginRecovery * widest, 0.5F * (price.logFine - price.logCoarse));
  price.logFine -= step;
  price.logCoarse += step;
}

}  // namespace

gpu::PriceState firstPrice() {
  return {0.0F, 0.0F, gpu::kMostGain, 0.0F};
}

gpu::PriceState adjustPrice(gpu::PriceState price, float triangles, const gpu::CullView& view) {
  JAL_CHECK(view.triangleBudget > 0U);
  const float error = std::log(std::max(triangles, 1.0F) / static_cast<float>(view.triangleBudget));
  const float gain = gainOf(price, error);
  const float widest = view.calm != 0 ? 4.0F * std::log(view.hysteresis) : 0.0F;
  if (price.logFine - price.logCoarse > widest) {
    const float middle = 0.5F * (price.logFine + price.logCoarse);
    price.logFine = middle + 0.5F * widest;
    price.logCoarse = middle - 0.5F * widest;
  }
  const bool within = std::abs(error) <= gpu::kBudgetTolerance;
  if (!within && !(error < 0.0F && gain <= gpu::kLeastGain))
    move(price, std::clamp(gain * error, -gpu::kMostLogStep, gpu::kMostLogStep), widest);
  if (within) recover(price, widest);
  price.gain = gain;
  price.lastError = error;
  return price;
}

float priceFactor(const gpu::PriceState& price, const gpu::CullView& view, float margin) {
  if (view.triangleBudget == 0) return 1.0F;
  if (margin < 1.0F) return std::exp(price.logFine);
  return std::exp(margin > 1.0F ? price.logCoarse : 0.5F * (price.logFine + price.logCoarse));
}

}  // namespace jalousie::visibility
