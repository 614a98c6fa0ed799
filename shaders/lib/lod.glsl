// LV -> detail (thesis 4.1.3).  CPU twin: src/visibility/lod_policy.cpp

/// Share of hiddenness in [0, 1]: 0 open, 1 covered. LV can fall below -1 and is clamped.
float hiddenShare(float lv) { return (clamp(lv, -1.0, 1.0) + 1.0) * 0.5; }

/// floor(mix(levels, 1, t)): LV = 641 of 1024 with 20 levels gives 4.
uint tessellationLevel(float lv, uint levels) {
  float t = hiddenShare(lv);
  return uint(clamp(floor(mix(float(levels), 1.0, t)), 1.0, float(levels)));
}

/// The same mapping onto a chain: LOD 0 when open, the coarsest when covered.
uint linearLod(float lv, uint lodCount) { return lodCount - tessellationLevel(lv, lodCount); }
