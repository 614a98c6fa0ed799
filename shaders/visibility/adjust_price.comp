// Moves the price of a triangle so that the next frame's triangles come closer to the budget (docs/lod_selection.md).
//
// One thread. Reads counters and CullView. Changes the state of the price. Barrier owed: UNIFORM for the next frame's
// classify.comp. CPU twin: src/visibility/price_control.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/frame_structs.h"

layout(local_size_x = 1) in;
layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std430, binding = kBindingCounters) readonly buffer CounterBlock { uint counters[]; };
layout(std430, binding = kBindingPriceState) buffer PriceStateBlock { PriceState price; };

void main() {
  float triangles = 0.0;
  for (int limb = 3; limb >= 0; --limb) triangles = triangles * 1024.0 + float(counters[kCounterTriangles + limb]);
  float error = log(max(triangles, 1.0) / float(cullView.triangleBudget));
  float most = cullView.calm != 0u ? kMostCalmGain : kMostGain;
  float gain = min(price.gain, most);
  if (abs(error) - abs(price.lastError) > kBudgetJump) {
    gain = most;
  } else if (error * price.lastError < 0.0) {
    gain = max(0.5 * gain, 0.5 * kLeastGain);
  } else if (error > kBudgetTolerance || error < price.lastError - kBudgetTolerance) {
    gain = min(kGainGrowth * gain, most);
  }
  bool atRest = abs(error) <= kBudgetTolerance || (error < 0.0 && gain <= kLeastGain);
  if (!atRest) {
    float step = clamp(gain * error, -kMostLogStep, kMostLogStep);
    price.logFactor = clamp(price.logFactor + step, -kMostLogFactor, kMostLogFactor);
  }
  price.gain = gain;
  price.lastError = error;
}
