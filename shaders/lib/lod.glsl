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

/// How much a hidden object's budget grows: 1 for an open one, 1 + relax for a hidden one.
float relaxedBudget(float lv, float relax) {
  float h = hiddenShare(lv);
  float h2 = h * h;
  return 1.0 + relax * h2 * h2;  // kRelaxPower
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

/// Lowest tessellation level whose flat pieces stay within tau of the curved surface: the gap of a quadratic patch
/// falls with the square of the level.
uint pixelErrorTessellation(float errorPixels, float tau, uint maxLevel) {
  if (errorPixels <= tau) return 1u;
  return uint(clamp(ceil(sqrt(errorPixels / tau)), 1.0, float(maxLevel)));
}

/// Detail of an object under the view's rule.
void chooseDetail(Chain chain, float pixelsPerUnit, float tau, inout ObjectState state) {
  if (cullView.lodRule == kLodLinear) {
    state.lod = linearLod(state.lv, chain.lodCount);
    state.tessellation = tessellationLevel(state.lv, cullView.maxTessellation);
  } else if (cullView.lodRule == kLodPixelError || cullView.lodRule == kLodLvError) {
    float budget = cullView.lodRule == kLodLvError ? tau * relaxedBudget(state.lv, cullView.relax) : tau;
    state.lod = pixelErrorLod(chain, pixelsPerUnit, budget);
    state.tessellation = pixelErrorTessellation(lods[chain.patchLod].errorObject * pixelsPerUnit, budget,
                                                cullView.maxTessellation);
  }
}
