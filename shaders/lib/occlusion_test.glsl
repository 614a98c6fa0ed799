// Overlap test of a box on the screen (thesis 3.4; docs/two_phase_culling.md).
// JAL_USES_MAP: against the occlusion map. JAL_USES_DEPTH: against the depth pyramid; with both, the map counts where
// the occluders lie in front of the box. Include lib/overlap.glsl and the block of CullView before.
// CPU twin: src/visibility/overlap_reference.cpp

#ifdef JAL_USES_MAP
layout(binding = kUnitOcclusionMap) uniform sampler2D occlusionMap;
#endif
#ifdef JAL_USES_DEPTH
layout(binding = kUnitDepthPyramid) uniform sampler2D depthPyramid;  // level L of the screen is its level L - 1
layout(binding = kUnitDepth) uniform sampler2D depthBuffer;
#endif

uvec2 viewport() { return uvec2(cullView.viewportWidth, cullView.viewportHeight); }

/// Covered share of the pixels of a texel, for a box at a depth.
float opacity(uvec2 texel, uint level, float nearestDepth) {
  float covered = 1.0;
#ifdef JAL_USES_DEPTH
  float farthest = level == 0u ? texelFetch(depthBuffer, ivec2(texel), 0).r
                               : texelFetch(depthPyramid, ivec2(texel), int(level) - 1).r;
  if (!(farthest > nearestDepth)) return 0.0;
#endif
#ifdef JAL_USES_MAP
  covered -= texelFetch(occlusionMap, ivec2(texel), int(level)).r / float(texelArea(texel, level, viewport()));
#endif
  return covered;
}

/// Where the test of one box looks.
struct Probe {
  vec4 rect;           // bounding rectangle, pixels, with the guard
  uvec4 pixels;        // that it touches: first.xy, last.xy
  uint lom;            // level at which the rectangle is about one texel wide
  float nearestDepth;  // of the box
};

/// @param rect  bounding rectangle, pixels, clipped to the viewport
Probe probeOf(vec4 rect, float nearestDepth) {
  Probe probe;
  probe.rect = rect;
#if defined(JAL_USES_MAP) && defined(JAL_USES_DEPTH)
  // The levels drawn into the map may be off by occluderTau pixels.
  float guard = ceil(cullView.occluderTau);
  probe.rect = clamp(probe.rect + vec4(-guard, -guard, guard, guard), vec4(0.0), vec4(viewport().xyxy));
#endif
  probe.pixels = touchedPixels(probe.rect, viewport());
  float extent = max(probe.rect.z - probe.rect.x, probe.rect.w - probe.rect.y);
  probe.lom = min(levelForExtent(extent), cullView.mapLevels - 1u);
  probe.nearestDepth = nearestDepth;
  return probe;
}

/// Lowest and highest opacity of the texels that the rectangle touches at a level.
vec2 opacityRange(Probe probe, uint level) {
  uvec4 texels = probe.pixels >> level;
  vec2 range = vec2(1.0, 0.0);
  for (uint y = texels.y; y <= texels.w; ++y) {
    for (uint x = texels.x; x <= texels.z; ++x) {
      float value = opacity(uvec2(x, y), level, probe.nearestDepth);
      range = vec2(min(range.x, value), max(range.y, value));
    }
  }
  return range;
}

/// The same at LOM or, where a texel is open, at up to kMaxDescent levels below it.
vec2 overlap(Probe probe) {
  uint lowest = probe.lom > kMaxDescent ? probe.lom - kMaxDescent : 0u;
  vec2 range = opacityRange(probe, probe.lom);
  for (uint level = probe.lom; range.x < cullView.cullThreshold && level > lowest;) {
#ifndef JAL_USES_DEPTH
    if (range.y <= 0.0) break;  // open here, so open below: opacities add up. A farthest depth does not
#endif
    range = opacityRange(probe, --level);
  }
  return range;
}
