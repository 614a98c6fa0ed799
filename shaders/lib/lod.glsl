// Visibility and size on screen -> detail. CPU twin: src/visibility/lod_policy.cpp

/// Share of hiddenness in [0, 1]: 0 open, 1 covered. LV can fall below -1 and is clamped.
float hiddenShare(float lv) { return (clamp(lv, -1.0, 1.0) + 1.0) * 0.5; }

/// floor(mix(levels, 1, t)): LV = 641 of 1024 with 20 levels gives 4 (thesis 4.1.3).
uint tessellationLevel(float lv, uint levels) {
  float t = hiddenShare(lv);
  return uint(clamp(floor(mix(float(levels), 1.0, t)), 1.0, float(levels)));
}

/// The same mapping onto a chain: LOD 0 when open, the coarsest when covered.
uint linearLod(float lv, uint lodCount) { return lodCount - tessellationLevel(lv, lodCount); }

float visibleShare(float lv) { return max(1.0 - hiddenShare(lv), kLeastShare); }

/// How much a hidden object's budget grows: (visible share)^(-1/4), at most 1 + relax (docs/lod_selection.md).
float relaxedBudget(float lv, float relax) {
  float share = visibleShare(lv);
  return min(inversesqrt(sqrt(share)), 1.0 + relax);
}

/// LV of an object of which `visible` pixels showed, in a rectangle of `area` pixels.
float pixelsLv(float visible, float area) {
  return 1.0 - 2.0 * min((visible + kPixelGuard) / (kSilhouetteShare * area + kPixelGuard), 1.0);
}

/// LV on its way from the last frame's value to the one just measured.
float smoothLv(float last, float measured) {
  float start = clamp(last, -1.0, 1.0);
  return start + (measured < start ? kSmoothAppearing : kSmoothHiding) * (clamp(measured, -1.0, 1.0) - start);
}

/// LV of what is out of view: nothing is known of it, and after a while it counts as open.
float forgottenLv(float last) {
  float start = clamp(last, -1.0, 1.0);
  return start + kSmoothHiding * (-1.0 - start);
}

/// Pixels that an error of one object-space unit can cover (docs/lod_selection.md):
/// scale * focalPixels / max(distance - radius, zNear).
float projectedScale(float scale, float focalPixels, float distance, float radius, float zNear) {
  return scale * focalPixels / max(distance - radius, zNear);
}

/// Coarsest level whose error projects to at most tau pixels; LOD 0 if none does.
uint pixelErrorLod(Chain chain, float pixelsPerUnit, float tau) {
  for (uint level = chain.lodCount - 1u; level > 0u; --level)
    if (lods[chain.firstLod + level].errorObject * pixelsPerUnit <= tau) return level;
  return 0u;
}

/// Level between the ones that tau and tau * relaxed allow: the least sum of the error's weight and the triangles, as
/// shares of what tau allows (docs/lod_selection.md). A coarser level that saves little is not worth its error.
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

/// Lowest tessellation level whose flat pieces stay within tau of the curved surface: the gap of a quadratic patch
/// falls with the square of the level.
uint pixelErrorTessellation(float errorPixels, float tau, uint maxLevel) {
  if (errorPixels <= tau) return 1u;
  return uint(clamp(ceil(sqrt(errorPixels / tau)), 1.0, float(maxLevel)));
}

uint fadeFrames(uint mark) { return mark >> kMarkFadeShift; }

/// The level that fades out.
uint fadingLod(uint lod, uint mark) { return (mark & kMarkFromCoarser) != 0u ? lod + 1u : lod - 1u; }

/// One step from the last level towards the range that it may keep.
uint stepTowards(uint last, uint lowest, uint highest) {
  return last < lowest ? last + 1u : last > highest ? last - 1u : last;
}

/// Levels that follow a budget calmly: they keep while they fit within the hysteresis, change by one, and fade. What no
/// pixel shows need not fade.
void followBudget(Chain chain, float pixelsPerUnit, float tau, float relaxed, float share, bool seen, ObjectState last,
                  inout ObjectState state, inout uint mark) {
  float patchPixels = lods[chain.patchLod].errorObject * pixelsPerUnit;
  float budget = tau * relaxed;
  state.tessellation =
      stepTowards(last.tessellation, pixelErrorTessellation(patchPixels, budget * cullView.hysteresis, cullView.maxTessellation),
                  pixelErrorTessellation(patchPixels, budget / cullView.hysteresis, cullView.maxTessellation));
  state.lod = last.lod;
  uint left = min(fadeFrames(mark), cullView.fadeFrames + 1u);  // fewer may be wanted than when the fade began
  if (seen && left > 1u) {
    mark = (mark & kMarkFromCoarser) | (mark & ~kMarkFadeMask) | ((left - 1u) << kMarkFadeShift);
    return;
  }
  mark &= ~kMarkFadeMask;
  uint finest = relaxedLod(chain, pixelsPerUnit, tau / cullView.hysteresis, relaxed, share);
  uint coarsest = max(finest, relaxedLod(chain, pixelsPerUnit, tau * cullView.hysteresis, relaxed, share));
  state.lod = seen ? stepTowards(last.lod, finest, coarsest) : clamp(last.lod, finest, coarsest);
  if (seen && state.lod != last.lod && !hasTrait(kTraitPatches) && cullView.fadeFrames > 0u)
    mark |= (cullView.fadeFrames << kMarkFadeShift) | (last.lod > state.lod ? kMarkFromCoarser : 0u);
}

/// Detail of an object under the view's rule. @param seen  whether a pixel of the last frame showed it, or nobody knows
/// @param last  of the frame before, where mark says kMarkKnown or kMarkRemembered
void chooseDetail(Chain chain, float pixelsPerUnit, float tau, bool seen, ObjectState last, inout ObjectState state,
                  inout uint mark) {
  bool followsError = hasTrait(kTraitFollowsError), followsLv = hasTrait(kTraitFollowsLv);
  bool calm = followsError && (mark & kMarkRemembered) != 0u;
  if (!calm) mark &= ~kMarkFadeMask;  // a fade that began in calm frames ends with them
  if (followsLv && !followsError) {
    state.lod = linearLod(state.lv, chain.lodCount);
    state.tessellation = tessellationLevel(state.lv, cullView.maxTessellation);
  } else if (followsError) {
    float relaxed = followsLv ? relaxedBudget(state.lv, cullView.relax) : 1.0;
    float share = visibleShare(state.lv);
    if (calm) {
      followBudget(chain, pixelsPerUnit, tau, min(relaxed, kMostCalmRelaxed), max(share, kLeastCalmShare), seen,
                   last, state, mark);
    } else {
      state.lod = relaxedLod(chain, pixelsPerUnit, tau, relaxed, share);
      state.tessellation = pixelErrorTessellation(lods[chain.patchLod].errorObject * pixelsPerUnit, tau * relaxed,
                                                  cullView.maxTessellation);
    }
  }
  bool same = hasTrait(kTraitPatches) ? state.tessellation == last.tessellation : state.lod == last.lod;
  if ((mark & kMarkKnown) != 0u && !same) mark |= kMarkSwitched;
}
