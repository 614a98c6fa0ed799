// One step of a damped controller on the logarithm of the price.
#include "visibility/price_control.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "shared/limits.h"

namespace jalousie::visibility {
namespace {

/// Whether a price a little lower was found to be above the budget a few frames ago, and this one is below it.
/// @param error  logarithm of triangles over budget
bool isBracketed(const gpu::PriceState& price, float error, bool calm) {
  return !calm && error < -gpu::kBudgetJump && price.overAge <= gpu::kOverFrames && price.logOver < price.logFine;
}

/// Gain of this step. @param error  as isBracketed
float gainOf(const gpu::PriceState& price, float error, bool calm) {
  if (isBracketed(price, error, calm)) {
    const bool isNarrow = price.logFine - price.logOver <= gpu::kNarrowestStep;
    return isNarrow ? 0.5F * gpu::kLeastGain : std::max(0.5F * price.gain, gpu::kLeastGain);
  }
  if (std::abs(error) - std::abs(price.lastError) > gpu::kBudgetJump) return gpu::kMostGain;
  const float least = calm ? gpu::kLeastGain : gpu::kLeastGain * gpu::kLeastSmallGain;
  if (error * price.lastError < 0.0F) return std::max(0.5F * price.gain, 0.5F * least);
  const bool stays = error <= gpu::kBudgetTolerance && error >= price.lastError - gpu::kBudgetTolerance;
  if (stays) return price.gain;
  const float growth = price.gain < 0.5F * gpu::kLeastGain ? gpu::kSmallGainGrowth : gpu::kGainGrowth;
  return std::min(growth * price.gain, gpu::kMostGain);
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

/// Without calm levels. Above the budget, levels that are finer by the price of small steps go first. Below it, all
/// levels follow, or where this came to rest only those of small steps.
void moveAll(gpu::PriceState& price, float error, float gain) {
  const bool isBounded = isBracketed(price, error, /*calm=*/false);
  const float least = 0.5F * (price.logOver + price.logFine);
  const bool rests = gain < gpu::kLeastGain || (gain == gpu::kLeastGain && !isBounded);
  const float smallGain = gain / gpu::kLeastGain;  // of the price of small steps
  if (rests && error < 0.0F && smallGain <= gpu::kLeastSmallGain) return;
  // Away from the step that the price came to rest at: a few visible pixels more must not take it.
  if (rests && error < 0.0F && price.logCoarse == price.logFine) price.logFine += 8.0F * gpu::kBudgetTolerance;
  const float step = std::clamp((rests ? smallGain : gain) * error, -gpu::kMostLogStep, gpu::kMostLogStep);
  price.logCoarse = std::clamp(price.logCoarse + step, -gpu::kMostLogFactor, gpu::kMostLogFactor);
  if (step < 0.0F && !rests) price.logFine = std::max(price.logFine + step, -gpu::kMostLogFactor);
  if (step > 0.0F) price.logFine = std::max(price.logFine, price.logCoarse);
  if (isBounded && !rests) price.logFine = price.logCoarse = std::max(price.logFine, least);
  price.logCoarse = std::min(price.logCoarse, price.logFine);
}

/// Keeps the price of a frame above the budget.
void noteOver(gpu::PriceState& price, float error) {
  const bool isOver = error > gpu::kBudgetTolerance && price.logCoarse == price.logFine;
  if (isOver) price.logOver = price.logFine;
  price.overAge = isOver ? 0.0F : std::min(price.overAge + 1.0F, 2.0F * gpu::kOverFrames);
}

void recover(gpu::PriceState& price, float widest) {
  const float step = std::min(gpu::kMarginRecovery * widest, 0.5F * (price.logFine - price.logCoarse));
  price.logFine -= step;
  price.logCoarse += step;
}

}  // namespace

gpu::PriceState firstPrice() {
  return {0.0F, 0.0F, gpu::kMostGain, 0.0F, 0.0F, 2.0F * gpu::kOverFrames, 0.0F, 0.0F};
}

gpu::PriceState adjustPrice(gpu::PriceState price, float triangles, const gpu::CullView& view) {
  JAL_CHECK(view.triangleBudget > 0U);
  const float error = std::log(std::max(triangles, 1.0F) / static_cast<float>(view.triangleBudget));
  noteOver(price, error);
  const float gain = gainOf(price, error, view.calm != 0);
  const bool calm = view.calm != 0;
  const float widest = calm ? 4.0F * std::log(view.hysteresis) : 0.0F;
  if (calm && price.logFine - price.logCoarse > widest) {
    const float middle = 0.5F * (price.logFine + price.logCoarse);
    price.logFine = middle + 0.5F * widest;
    price.logCoarse = middle - 0.5F * widest;
  }
  const bool within = std::abs(error) <= gpu::kBudgetTolerance;
  if (!within && !calm) moveAll(price, error, gain);
  if (!within && calm && !(error < 0.0F && gain <= gpu::kLeastGain))
    move(price, std::clamp(gain * error, -gpu::kMostLogStep, gpu::kMostLogStep), widest);
  if (within && calm) recover(price, widest);
  price.gain = gain;
  price.lastError = error;
  return price;
}

float priceFactor(const gpu::PriceState& price, const gpu::CullView& view, float margin) {
  if (view.triangleBudget == 0) return 1.0F;
  const float middle = 0.5F * (price.logFine + price.logCoarse);
  if (margin == 1.0F) return std::exp(view.calm != 0 ? middle : price.logFine);
  return std::exp(margin < 1.0F ? price.logFine : price.logCoarse);
}

bool pricesSmallSteps(const gpu::PriceState& price, const gpu::CullView& view) {
  return view.triangleBudget > 0 && view.calm == 0 && price.logCoarse < price.logFine;
}

bool isSmallStep(gpu::uint fewer, gpu::uint more, const gpu::CullView& view) {
  return static_cast<float>(more) - static_cast<float>(fewer) <=
         gpu::kBudgetSmallStep * static_cast<float>(view.triangleBudget);
}

}  // namespace jalousie::visibility
