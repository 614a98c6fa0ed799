// Colours of the debug views (docs/level_of_visibility.md).

/// Occluders red, occludees blue, lighter = coarser (thesis Fig. 4.3). coarseness in [0, 1]. Linear RGB.
vec3 lodColor(bool occluder, float coarseness) {
  if (occluder) return mix(vec3(0.55, 0.02, 0.02), vec3(1.0, 0.45, 0.40), coarseness);
  return mix(vec3(0.005, 0.02, 0.35), vec3(0.55, 0.85, 1.0), coarseness);
}

/// Grey = drawn before the test and visible, orange = only after it, red = before it though hidden now. Linear RGB.
vec3 phaseColor(uint verdict, uint mark) {
  if (verdict == kVerdictStale) return vec3(0.75, 0.03, 0.03);
  return (mark & kMarkEarly) != 0u ? vec3(0.32, 0.36, 0.40) : vec3(0.95, 0.38, 0.02);
}

/// Lines over a surface of that colour: what stands out from it. Linear RGB.
vec3 lineColor(vec3 surface) { return dot(surface, vec3(0.2126, 0.7152, 0.0722)) < 0.18 ? vec3(0.5) : vec3(0.0); }

/// What was culled, by the reason: hidden magenta, too small yellow, out of the frustum grey-blue. Linear RGB.
vec3 ghostColor(uint verdict) {
  if (verdict == kVerdictOccluded) return vec3(0.90, 0.05, 0.45);
  return verdict == kVerdictSmall ? vec3(0.90, 0.70, 0.05) : vec3(0.25, 0.40, 0.65);
}

/// What is out of the frustum is much, and says little.
float ghostOpacity(uint verdict) { return verdict == kVerdictOutside ? 0.03 : 0.15; }

/// Heat scale for t in [0, 1], dark blue over green to yellow: a cubic fit of a perceptually even ramp. Linear RGB.
vec3 heatColor(float t) {
  vec3 low = vec3(0.06, 0.01, 0.14), mid = vec3(0.02, 0.27, 0.26), high = vec3(0.98, 0.80, 0.05);
  return t < 0.5 ? mix(low, mid, 2.0 * t) : mix(mid, high, 2.0 * t - 1.0);
}
