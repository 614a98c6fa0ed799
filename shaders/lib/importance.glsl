// Importance of a screen region: the largest value of a mask over it (Tai and Hsu: importance culling).
// CPU twin: src/visibility/importance_mask.cpp

layout(binding = kUnitImportance) uniform sampler2D importanceMask;

/// @param rect  pixels, clipped to the viewport   @return  in [kLeastImportance, 1]; 1 without a mask
float importanceOf(vec4 rect) {
  if (cullView.importanceLevels == 0u) return 1.0;
  vec2 size = vec2(cullView.importanceWidth, cullView.importanceHeight);
  vec2 viewport = vec2(cullView.viewportWidth, cullView.viewportHeight);
  vec4 scaled = rect / viewport.xyxy * size.xyxy;
  uvec4 touched = touchedPixels(scaled, uvec2(cullView.importanceWidth, cullView.importanceHeight));
  uint level = min(levelForExtent(max(scaled.z - scaled.x, scaled.w - scaled.y)), cullView.importanceLevels - 1u);
  uvec4 texels = touched >> level;
  float importance = kLeastImportance;
  for (uint y = texels.y; y <= texels.w; ++y)
    for (uint x = texels.x; x <= texels.z; ++x)
      importance = max(importance, texelFetch(importanceMask, ivec2(x, y), int(level)).r);
  return importance;
}
