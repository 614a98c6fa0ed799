// Frustum test, screen rectangle and occluder distance of one box (thesis 3.2, 3.4, 4.1.2).
// CPU twin: src/visibility/classify_reference.cpp

struct BoxOnScreen {
  bool outside;       // every corner lies beyond one plane of the clip volume
  bool crossesNear;   // some corner has w <= 0: no finite rectangle
  vec4 rect;          // min.xy, max.xy in pixels, clipped to the viewport; valid unless outside or crossesNear
  vec3 minWorld;      // axis-aligned world box of the transformed corners
  vec3 maxWorld;
};

vec3 boxCorner(vec3 lower, vec3 upper, uint corner) {
  return vec3((corner & 1u) != 0u ? upper.x : lower.x, (corner & 2u) != 0u ? upper.y : lower.y,
              (corner & 4u) != 0u ? upper.z : lower.z);
}

/// Clip space is that of CullView: -w <= x, y <= w and 0 <= z <= w.
BoxOnScreen boxOnScreen(vec4 row0, vec4 row1, vec4 row2, vec3 lower, vec3 upper, mat4 clipFromWorld, vec2 viewport) {
  BoxOnScreen result;
  result.minWorld = vec3(uintBitsToFloat(0x7f800000u));
  result.maxWorld = -result.minWorld;
  vec2 lowest = result.minWorld.xy;
  vec2 highest = result.maxWorld.xy;
  float smallestW = uintBitsToFloat(0x7f800000u);
  uint beyondAll = 63u;
  for (uint corner = 0u; corner < 8u; ++corner) {
    vec3 world = transformPoint(row0, row1, row2, boxCorner(lower, upper, corner));
    result.minWorld = min(result.minWorld, world);
    result.maxWorld = max(result.maxWorld, world);
    vec4 clip = clipFromWorld * vec4(world, 1.0);
    uint beyond = (clip.x < -clip.w ? 1u : 0u) | (clip.x > clip.w ? 2u : 0u) | (clip.y < -clip.w ? 4u : 0u) |
                  (clip.y > clip.w ? 8u : 0u) | (clip.z < 0.0 ? 16u : 0u) | (clip.z > clip.w ? 32u : 0u);
    beyondAll &= beyond;
    smallestW = min(smallestW, clip.w);
    vec2 pixels = (clip.xy / clip.w * 0.5 + 0.5) * viewport;
    lowest = min(lowest, pixels);
    highest = max(highest, pixels);
  }
  result.outside = beyondAll != 0u;
  result.crossesNear = !(smallestW > 0.0);
  result.rect = vec4(clamp(lowest, vec2(0.0), viewport), clamp(highest, vec2(0.0), viewport));
  return result;
}

/// Distance from a point to the closest point of a box; 0 inside.
float distanceToBox(vec3 point, vec3 lower, vec3 upper) {
  return length(max(max(lower - point, point - upper), vec3(0.0)));
}
