// Chooses the level of detail from the level of visibility and the size on the screen. Include a file with CullView,
// chains and lods before. CPU twin: src/visibility/lod_policy.cpp
#include "lib/fading.glsl"
#include "lib/masking.glsl"

/// Of the last frame, with a budget of triangles.
layout(std140, binding = kBindingPrice) uniform PriceBlock { PriceState priceState; };

/// Occluded share in [0, 1]: 0 fully visible, 1 fully occluded. LV can lie below -1 and is clamped.
float hiddenShare(float lv) { return (clamp(lv, -1.0, 1.0) + 1.0) * 0.5; }

/// floor(mix(levels, 1, t)): LV = 641 of 1024 with 20 levels gives 4 (thesis 4.1.3).
uint tessellationLevel(float lv, uint levels) {
  float t = hiddenShare(lv);
  return uint(clamp(floor(mix(float(levels), 1.0, t)), 1.0, float(levels)));
}

/// The same mapping onto a chain: LOD 0 for a fully visible object, the coarsest for an occluded one.
uint linearLod(float lv, uint lodCount) { return lodCount - tessellationLevel(lv, lodCount); }

/// Visible share in (0, 1].
float visibleShare(float lv) { return max(1.0 - hiddenShare(lv), kLeastShare); }

/// Factor by which the budget of a partly occluded object grows: (visible share)^(-1/4), at most 1 + relax
/// (docs/lod_selection.md).
float relaxedBudget(float lv, float relax) {
  float share = visibleShare(lv);
  return min(inversesqrt(sqrt(share)), 1.0 + relax);
}

/// LV of an object with `visible` visible pixels and a bounding rectangle of `area` pixels.
float pixelsLv(float visible, float area) {
  return 1.0 - 2.0 * min((visible + kPixelGuard) / (kSilhouetteShare * area + kPixelGuard), 1.0);
}

/// Visible pixels of an object with a level of visibility, the inverse of pixelsLv: at most the share of the rectangle
/// that an object in full sight is taken to fill.
float visiblePixels(float lv, float area) {
  return max(visibleShare(lv) * (kSilhouetteShare * area + kPixelGuard) - kPixelGuard, 0.0);
}

/// LV smoothed over time: one step from the last frame's value towards the measured one.
float smoothLv(float last, float measured) {
  float start = clamp(last, -1.0, 1.0);
  return start + (measured < start ? kSmoothAppearing : kSmoothHiding) * (clamp(measured, -1.0, 1.0) - start);
}

/// LV of an object out of view, which cannot be measured: one step from the last frame's value towards fully visible.
float forgottenLv(float last) {
  float start = clamp(last, -1.0, 1.0);
  return start + kSmoothHiding * (-1.0 - start);
}

/// Pixels that an error of one object-space unit can cover (docs/lod_selection.md):
/// scale * focalPixels / max(distance, zNear).
float projectedScale(float scale, float focalPixels, float distance, float zNear) {
  return scale * focalPixels / max(distance, zNear);
}

/// Coarsest level whose error projects to at most tau pixels; LOD 0 if none does.
uint pixelErrorLod(Chain chain, float pixelsPerUnit, float tau) {
  for (uint level = chain.lodCount - 1u; level > 0u; --level)
    if (lods[chain.firstLod + level].errorObject * pixelsPerUnit <= tau) return level;
  return 0u;
}

/// Share of the screen's area that the bounding sphere of a box covers, at the distance of pixelsPerUnit; not clipped.
float sphereCoverage(vec3 sizeObject, float pixelsPerUnit) {
  float diameter2 = dot(sizeObject, sizeObject) * pixelsPerUnit * pixelsPerUnit;
  return kQuarterPi * diameter2 / (float(cullView.viewportWidth) * float(cullView.viewportHeight));
}

/// Finest level whose threshold an object reaches; the coarsest where none does, LOD 0 where the coverage is not a
/// number (docs/lod_selection.md).
uint coverageLod(Chain chain, float coverage) {
  for (uint level = 0u; level + 1u < chain.lodCount; ++level)
    if (!(coverage < lods[chain.firstLod + level].leastCoverage)) return level;
  return chain.lodCount - 1u;
}

/// Level between the ones that tau and tau * relaxed allow, with the least share * (error / tau)^2 + triangles /
/// (triangles at tau) (docs/lod_selection.md). A coarser level that saves few triangles is not worth its error.
uint relaxedLod(Chain chain, float pixelsPerUnit, float tau, float relaxed, float share) {
  uint best = pixelErrorLod(chain, pixelsPerUnit, tau);
  uint coarsest = pixelErrorLod(chain, pixelsPerUnit, tau * relaxed);
  float triangles = float(max(lods[chain.firstLod + best].triangleCount, 1u));
  float leastCost = 0.0;
  for (uint level = best; level <= coarsest; ++level) {
    Lod lod = lods[chain.firstLod + level];
    float error = lod.errorObject * pixelsPerUnit / max(tau, kLeastShare);
    float cost = share * error * error + float(lod.triangleCount) / triangles;
    if (leastCost == 0.0 || cost < leastCost) {
      leastCost = cost;
      best = level;
    }
  }
  return best;
}

/// What the error and the triangles of one object cost (docs/lod_selection.md).
struct Price {
  float pixels;       // of the object, visible
  float perTriangle;  // pixels of area times pixels of error
  float maxError;     // limit of the largest deviation, pixels
};

/// The larger the error, the more each visible pixel of the object costs, up to kErrorCap.
float costAt(Price price, float errorPixels, float triangles) {
  return (price.pixels + 1.0) * (errorPixels < kErrorCap ? errorPixels : kErrorCap) + price.perTriangle * triangles;
}

/// Level with the least cost, the finer one of equals. Levels beyond the limit of the largest deviation and those of
/// unknown error do not count.
uint pricedLod(Chain chain, float pixelsPerUnit, Price price) {
  uint best = 0u;
  float leastCost = costAt(price, 0.0, float(lods[chain.firstLod].triangleCount));
  for (uint level = 1u; level < chain.lodCount; ++level) {
    Lod lod = lods[chain.firstLod + level];
    if (isinf(lod.meanErrorObject) || !(lod.errorObject * pixelsPerUnit <= price.maxError)) continue;
    float cost = costAt(price, lod.meanErrorObject * pixelsPerUnit, float(lod.triangleCount));
    if (cost < leastCost) {
      leastCost = cost;
      best = level;
    }
  }
  return best;
}

/// Triangles of one patch: rings of 6 (n - 1), 6 (n - 3), ... around the middle.
uint tessellatedTriangles(uint n) { return (n & 1u) != 0u ? 3u * (n * n - 1u) / 2u + 1u : 3u * n * n / 2u; }

/// Tessellation level with the least cost, the finer one of equals; the finest where all are beyond the limit.
/// @param errorPixels  of the untessellated base   @param triangles  of the base
uint pricedTessellation(float errorPixels, float triangles, Price price, uint maxLevel) {
  uint best = maxLevel;
  float leastCost = costAt(price, errorPixels / float(maxLevel * maxLevel),
                           triangles * float(tessellatedTriangles(maxLevel)));
  for (uint level = maxLevel - 1u; level > 0u; --level) {
    float error = errorPixels / float(level * level);
    if (!(error <= price.maxError)) break;
    float cost = costAt(price, error, triangles * float(tessellatedTriangles(level)));
    if (cost < leastCost) {
      leastCost = cost;
      best = level;
    }
  }
  return best;
}

/// Lowest tessellation level whose triangles stay within tau of the curved surface. The gap of a quadratic patch falls
/// with the square of the level.
uint pixelErrorTessellation(float errorPixels, float tau, uint maxLevel) {
  if (errorPixels <= tau) return 1u;
  return uint(clamp(ceil(sqrt(errorPixels / tau)), 1.0, float(maxLevel)));
}

/// Triangles that an object or a cell is drawn with, without a level that fades out.
uint trianglesAt(Chain chain, ObjectState state) {
  return hasTrait(kTraitPatches) ? lods[chain.patchLod].triangleCount * tessellatedTriangles(state.tessellation)
                                 : lods[chain.firstLod + state.lod].triangleCount;
}

/// Triangles of the level that fades out; 0 for none.
uint fadingTriangles(Chain chain, uint lod, uint mark) {
  bool fades = fadeFrames(mark) > 0u && !hasTrait(kTraitPatches);
  return fades ? lods[chain.firstLod + fadingLod(lod, mark)].triangleCount : 0u;
}

/// One step from the last level towards [lowest, highest].
uint stepTowards(uint last, uint lowest, uint highest) {
  return last < lowest ? last + 1u : last > highest ? last - 1u : last;
}

/// What the choice of detail needs to know of an object besides the view.
struct DetailInput {
  Chain chain;
  float pixelsPerUnit;  // as ScreenBox
  float tau;            // as ScreenBox
  float area;           // of the bounding rectangle, pixels; of the screen across the near plane; 0 out of view
  bool seen;            // a pixel of the last frame showed the object, or no count says
  ObjectState last;     // of the last frame, where the marks have kMarkKnown or kMarkRemembered
  uint cover;           // as ScreenBox; with kTraitMasksError it masks errors
};

/// What an object may deviate by on the screen, and what its triangles cost.
struct Budget {
  float tau;       // pixels, for a fully visible object
  float relaxed;   // factor for this one
  float share;     // visible share
  float pixels;    // visible pixels
  float maxError;  // limit of the largest deviation, pixels
  float masking;   // factor by which errors count less behind small holes
};

/// Whether an object fills little of its rectangle. A body in full sight covers a quarter of its surface on average
/// over all directions (Cauchy), and less where parts of it hide others.
bool isThin(DetailInput object, float area) {
  float surfacePixels = object.chain.surfaceObject * object.pixelsPerUnit * object.pixelsPerUnit;
  return 0.25 * surfacePixels < kThinShare * area;
}

/// Area that stays when an object turns, or comes into view at the border of the screen: that of its rectangle or, if
/// larger, the mean silhouette of its box (a quarter of the surface), at most the screen.
float steadyArea(DetailInput object) {
  vec3 size = (object.chain.boundsMaxObject.xyz - object.chain.boundsMinObject.xyz) * object.pixelsPerUnit;
  float silhouette = 0.5 * (size.x * size.y + size.y * size.z + size.z * size.x);
  return max(object.area, min(silhouette, float(cullView.viewportWidth) * float(cullView.viewportHeight)));
}

Budget budgetOf(DetailInput object, float lv, bool calm, bool counted) {
  float relaxed = hasTrait(kTraitFollowsLv) ? relaxedBudget(lv, cullView.relax) : 1.0;
  float area = calm ? steadyArea(object) : object.area;
  Budget budget = Budget(object.tau, relaxed, visibleShare(lv), visiblePixels(lv, area), cullView.maxError,
                         maskingInUse(object.cover));
  if (isThin(object, area)) budget.maxError = min(budget.maxError, object.tau * budget.masking);
  if (calm) {
    budget.relaxed = min(budget.relaxed, kMostCalmRelaxed / budget.masking);
    budget.share = max(budget.share, kLeastCalmShare);
    budget.pixels = max(budget.pixels, kLeastCalmVisible * kSilhouetteShare * area);
  } else if (counted && !object.seen) {
    budget.maxError = uintBitsToFloat(0x7f800000u);  // no pixel shows it
  }
  return budget;
}

/// Triangles cost more by the masking, which chooses the same level as errors that count less by it.
/// A price above that of tau relaxes the limit of the largest deviation as a larger tau would: the budget precedes it.
/// @param margin  scales tau; below 1 also the limit of the largest deviation   @param factor  of kTrianglePrice
Price priceOf(Budget budget, float margin, float factor) {
  float tau = budget.tau * margin;
  return Price(budget.pixels, kTrianglePrice * tau * tau * factor * budget.masking,
               budget.maxError * min(margin, 1.0) * max(sqrt(factor), 1.0));
}

/// Factor of kTrianglePrice at tau * margin; 1 without a budget of triangles.
float priceFactor(float margin) {
  if (cullView.triangleBudget == 0u) return 1.0;
  float middle = 0.5 * (priceState.logFine + priceState.logCoarse);
  if (margin == 1.0) return exp(cullView.calm != 0u ? middle : priceState.logFine);
  return exp(margin < 1.0 ? priceState.logFine : priceState.logCoarse);
}

/// Whether finer levels have a lower price where they add few triangles (PriceState).
bool pricesSmallSteps() {
  return cullView.triangleBudget > 0u && cullView.calm == 0u && priceState.logCoarse < priceState.logFine;
}

bool isSmallStep(uint fewer, uint more) {
  return float(more) - float(fewer) <= kBudgetSmallStep * float(cullView.triangleBudget);
}

/// Level of the chain at the prices in use.
uint budgetPricedLod(DetailInput object, Budget budget, float margin) {
  uint level = pricedLod(object.chain, object.pixelsPerUnit, priceOf(budget, margin, priceFactor(margin)));
  if (!pricesSmallSteps()) return level;
  Price price = priceOf(budget, margin, exp(priceState.logCoarse));
  uint finer = min(pricedLod(object.chain, object.pixelsPerUnit, price), level);
  uint first = object.chain.firstLod;
  while (!isSmallStep(lods[first + level].triangleCount, lods[first + finer].triangleCount)) ++finer;
  return finer;
}

/// Level of the chain that the budget allows at tau * margin. By coverage, an object counts as tau times smaller.
uint budgetLod(DetailInput object, Budget budget, float margin) {
  if (hasTrait(kTraitPrice)) return budgetPricedLod(object, budget, margin);
  float tau = budget.tau * margin * budget.masking;
  if (hasTrait(kTraitCoverage)) {
    vec3 size = object.chain.boundsMaxObject.xyz - object.chain.boundsMinObject.xyz;
    return coverageLod(object.chain, sphereCoverage(size, object.pixelsPerUnit) / (tau * tau));
  }
  return relaxedLod(object.chain, object.pixelsPerUnit, tau, budget.relaxed, budget.share);
}

/// The same for the patches.
uint budgetTessellation(DetailInput object, Budget budget, float margin) {
  Lod patches = lods[object.chain.patchLod];
  float errorPixels = patches.errorObject * object.pixelsPerUnit;
  if (hasTrait(kTraitPrice))
    return pricedTessellation(errorPixels, float(patches.triangleCount),
                              priceOf(budget, margin, priceFactor(margin)), cullView.maxTessellation);
  float tau = budget.tau * margin * budget.masking;
  return pixelErrorTessellation(errorPixels, tau * budget.relaxed, cullView.maxTessellation);
}

/// Levels that follow the budget with hysteresis: the last level stays while it fits within the margin, else it changes
/// by one and is cross-faded. An object of which no pixel was visible switches at once to the nearest level that fits.
void followBudget(DetailInput object, Budget budget, inout ObjectState state, inout uint mark) {
  float margin = cullView.hysteresis;
  state.tessellation = stepTowards(object.last.tessellation, budgetTessellation(object, budget, margin),
                                   budgetTessellation(object, budget, 1.0 / margin));
  state.lod = object.last.lod;
  uint left = min(fadeFrames(mark), cullView.fadeFrames + 1u);  // the fade may have begun with more frames
  if (object.seen && left > 1u) {
    mark = (mark & kMarkFromCoarser) | (mark & ~kMarkFadeMask) | ((left - 1u) << kMarkFadeShift);
    return;
  }
  mark &= ~kMarkFadeMask;
  uint finest = budgetLod(object, budget, 1.0 / margin);
  uint coarsest = max(finest, budgetLod(object, budget, margin));
  state.lod = object.seen ? stepTowards(object.last.lod, finest, coarsest) : clamp(object.last.lod, finest, coarsest);
  if (object.seen && state.lod != object.last.lod && !hasTrait(kTraitPatches) && cullView.fadeFrames > 0u)
    mark |= (cullView.fadeFrames << kMarkFadeShift) | (object.last.lod > state.lod ? kMarkFromCoarser : 0u);
}

/// Fills lod and tessellation under the view's rule; without kTraitFollowsError and kTraitFollowsLv they stay.
/// @param mark  gets kMarkSwitched and the frames of the cross-fade
void chooseDetail(DetailInput object, inout ObjectState state, inout uint mark) {
  bool followsError = hasTrait(kTraitFollowsError), followsLv = hasTrait(kTraitFollowsLv);
  bool calm = followsError && (mark & kMarkRemembered) != 0u;
  if (!calm) mark &= ~kMarkFadeMask;  // a fade that began in calm frames ends with them
  if (followsLv && !followsError) {
    state.lod = linearLod(state.lv, object.chain.lodCount);
    state.tessellation = tessellationLevel(state.lv, cullView.maxTessellation);
  } else if (followsError) {
    Budget budget = budgetOf(object, state.lv, calm, (mark & kMarkCounted) != 0u);
    if (calm) {
      followBudget(object, budget, state, mark);
    } else {
      state.lod = budgetLod(object, budget, 1.0);
      state.tessellation = budgetTessellation(object, budget, 1.0);
    }
  }
  bool same = hasTrait(kTraitPatches) ? state.tessellation == object.last.tessellation : state.lod == object.last.lod;
  if ((mark & kMarkKnown) != 0u && !same) mark |= kMarkSwitched;
}
