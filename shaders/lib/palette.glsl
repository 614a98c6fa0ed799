// Colours of the debug views as functions of what they show. Include first: shared/palette.h,
// shared/frame_structs.h.
// All results are linear RGB.

/// Occluders are red, other objects blue, coarser levels lighter (thesis Fig. 4.3).
/// @param coarseness  0 for the finest level, 1 for the coarsest
vec3 lodColor(bool occluder, float coarseness) {
  if (occluder) return mix(kColorFinestOccluder.rgb, kColorCoarsestOccluder.rgb, coarseness);
  return mix(kColorFinestLod.rgb, kColorCoarsestLod.rgb, coarseness);
}

/// A colour of its own for each of kLevelColors levels.
vec3 levelColor(uint level) {
  const vec4 colors[kLevelColors] =
      vec4[](kColorLevel0, kColorLevel1, kColorLevel2, kColorLevel3, kColorLevel4, kColorLevel5, kColorLevel6,
             kColorLevel7, kColorLevel8, kColorLevel9, kColorLevel10, kColorLevel11);
  return colors[level % kLevelColors].rgb;
}

/// Grey: drawn in phase 1; orange: in phase 2; red: in phase 1 although occluded.
vec3 phaseColor(uint verdict, uint mark) {
  if (verdict == kVerdictStale) return kColorStale.rgb;
  return (mark & kMarkEarly) != 0u ? kColorPhase1.rgb : kColorPhase2.rgb;
}

/// Colour of triangle edges that contrasts with the surface below them.
vec3 lineColor(vec3 surface) { return dot(surface, vec3(0.2126, 0.7152, 0.0722)) < 0.18 ? vec3(0.5) : vec3(0.0); }

/// A culled object by the reason: occluded magenta, too small yellow, outside the frustum grey-blue.
vec3 ghostColor(uint verdict) {
  if (verdict == kVerdictOutside) return kColorGhostOutside.rgb;
  return verdict == kVerdictSmall ? kColorGhostSmall.rgb : kColorGhostOccluded.rgb;
}

/// Opacity of a culled object. Objects outside the frustum are many and would cover the others, so they are fainter.
float ghostOpacity(uint verdict) { return verdict == kVerdictOutside ? 0.03 : 0.15; }

/// Heat scale, dark blue over green to yellow. @param t  in [0, 1]
vec3 heatColor(float t) {
  return t < 0.5 ? mix(kColorHeatLow.rgb, kColorHeatMiddle.rgb, 2.0 * t)
                 : mix(kColorHeatMiddle.rgb, kColorHeatHigh.rgb, 2.0 * t - 1.0);
}
