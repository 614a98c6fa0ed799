// Moves the price of a triangle so that the next frame's triangles come closer to the budget (docs/lod_selection.md).
//
// One thread. Reads budget and CullView. Changes the state of the price. Barrier owed: UNIFORM for the next frame's
// classify.comp. CPU twin: src/visibility/price_control.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/frame_structs.h"

layout(local_size_x = 1) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std140, binding = kBindingListView) uniform ListViewBlock { ListView listView; };
#include "lib/traits.glsl"
layout(std430, binding = kBindingPriceState) buffer PriceStateBlock { PriceState price; };
#include "lib/budget.glsl"

/// Whether a price a little lower was found to be above the budget a few frames ago, and this one is below it.
/// @param error  logarithm of triangles over budget
bool isBracketed(float error) {
  return cullView.calm == 0u && error < -kBudgetJump && price.overAge <= kOverFrames &&
         price.logOver < price.logFine;
}

/// Gain of this step. @param error  as isBracketed
float gainOf(float error) {
  if (isBracketed(error)) {
    bool isNarrow = price.logFine - price.logOver <= kNarrowestStep;
    return isNarrow ? 0.5 * kLeastGain : max(0.5 * price.gain, kLeastGain);
  }
  if (abs(error) - abs(price.lastError) > kBudgetJump) return kMostGain;
  float least = cullView.calm != 0u ? kLeastGain : kLeastGain * kLeastSmallGain;
  if (error * price.lastError < 0.0) return max(0.5 * price.gain, 0.5 * least);
  bool stays = error <= kBudgetTolerance && error >= price.lastError - kBudgetTolerance;
  if (stays) return price.gain;
  return min((price.gain < 0.5 * kLeastGain ? kSmallGainGrowth : kGainGrowth) * price.gain, kMostGain);
}

/// Above the budget the fine end of the margin rises, below it the coarse end falls. Each moves the other one along
/// when the margin has no width left.
void move(float step, float widest) {
  if (step > 0.0) {
    price.logFine = clamp(price.logFine + step, -kMostLogFactor, kMostLogFactor);
    price.logCoarse = max(price.logCoarse, price.logFine - widest);
  } else {
    price.logCoarse = clamp(price.logCoarse + step, -kMostLogFactor, kMostLogFactor);
    price.logFine = min(price.logFine, price.logCoarse + widest);
  }
}

/// Without calm levels. Above the budget, levels that are finer by the price of small steps go first. Below it, all
/// levels follow, or where this came to rest only those of small steps.
void moveAll(float error, float gain) {
  bool isBounded = isBracketed(error);
  float least = 0.5 * (price.logOver + price.logFine);
  bool rests = gain < kLeastGain || (gain == kLeastGain && !isBounded);
  float smallGain = gain / kLeastGain;  // of the price of small steps
  if (rests && error < 0.0 && smallGain <= kLeastSmallGain) return;
  // Away from the step that the price came to rest at: a few visible pixels more must not take it.
  if (rests && error < 0.0 && price.logCoarse == price.logFine) price.logFine += 8.0 * kBudgetTolerance;
  float step = clamp((rests ? smallGain : gain) * error, -kMostLogStep, kMostLogStep);
  price.logCoarse = clamp(price.logCoarse + step, -kMostLogFactor, kMostLogFactor);
  if (step < 0.0 && !rests) price.logFine = max(price.logFine + step, -kMostLogFactor);
  if (step > 0.0) price.logFine = max(price.logFine, price.logCoarse);
  if (isBounded && !rests) price.logFine = price.logCoarse = max(price.logFine, least);
  price.logCoarse = min(price.logCoarse, price.logFine);
}

/// Keeps the price of a frame above the budget.
void noteOver(float error) {
  bool isOver = error > kBudgetTolerance && price.logCoarse == price.logFine;
  if (isOver) price.logOver = price.logFine;
  price.overAge = isOver ? 0.0 : min(price.overAge + 1.0, 2.0 * kOverFrames);
}

void recover(float widest) {
  float step = min(kMarginRecovery * widest, 0.5 * (price.logFine - price.logCoarse));
  price.logFine -= step;
  price.logCoarse += step;
}

void main() {
  float triangles = budgetSum(kBudgetWanted) + budgetSum(kBudgetWanted + 2u);
  float error = log(max(triangles, 1.0) / float(cullView.triangleBudget));
  noteOver(error);
  float gain = gainOf(error);
  bool calm = cullView.calm != 0u;
  float widest = calm ? 4.0 * log(cullView.hysteresis) : 0.0;
  if (calm && price.logFine - price.logCoarse > widest) {
    float middle = 0.5 * (price.logFine + price.logCoarse);
    price.logFine = middle + 0.5 * widest;
    price.logCoarse = middle - 0.5 * widest;
  }
  bool within = abs(error) <= kBudgetTolerance;
  if (!within && !calm) moveAll(error, gain);
  if (!within && calm && !(error < 0.0 && gain <= kLeastGain))
    move(clamp(gain * error, -kMostLogStep, kMostLogStep), widest);
  if (within && calm) recover(widest);
  price.gain = gain;
  price.lastError = error;
}
