// Frustum test, screen rectangle, nearest depth and size of one box (thesis 3.2, 3.4, 4.1.2;
// docs/two_phase_culling.md).
// CPU twin: src/visibility/classify_reference.cpp
//
// All results are rounded outwards: the vertex stage computes the same sums for other points of the box, and each of
// the two may be off by kRounding times the sum of the magnitudes that went into the sum.

struct BoxOnScreen {
  bool outside;       // every corner lies beyond one plane of the clip volume
  bool crossesNear;   // some corner is not safely beyond the near plane: no finite rectangle
  vec4 rect;          // min.xy, max.xy in pixels, clipped to the viewport; valid unless outside or crossesNear
  float nearestDepth; // upper bound of the window depth; valid unless crossesNear
  vec3 minWorld;      // axis-aligned world box of the transformed corners
  vec3 maxWorld;
};

vec3 boxCorner(vec3 lower, vec3 upper, uint corner) {
  return vec3((corner & 1u) != 0u ? upper.x : lower.x, (corner & 2u) != 0u ? upper.y : lower.y,
              (corner & 4u) != 0u ? upper.z : lower.z);
}

/// Largest error of a clip-space component of any point of the box.
vec4 clipRounding(Transform t, vec3 lower, vec3 upper, mat4 clipFromWorld) {
  vec4 reach = vec4(max(abs(lower), abs(upper)), 1.0);
  vec3 world = vec3(dot(abs(t.worldFromObject0), reach), dot(abs(t.worldFromObject1), reach),
                    dot(abs(t.worldFromObject2), reach));
  return kRounding * (abs(clipFromWorld[0]) * world.x + abs(clipFromWorld[1]) * world.y +
                      abs(clipFromWorld[2]) * world.z + abs(clipFromWorld[3]));
}

/// One bit per plane of the clip volume that a corner lies safely beyond.
uint planesBeyond(vec4 clip, vec3 margin) {
  return (clip.x < -clip.w - margin.x ? 1u : 0u) | (clip.x > clip.w + margin.x ? 2u : 0u) |
         (clip.y < -clip.w - margin.y ? 4u : 0u) | (clip.y > clip.w + margin.y ? 8u : 0u) |
         (clip.z < -margin.z ? 16u : 0u) | (clip.z > clip.w + margin.z ? 32u : 0u);
}

/// Clip space is that of CullView: -w <= x, y <= w and 0 <= z <= w.
BoxOnScreen boxOnScreen(Transform t, vec3 lower, vec3 upper, mat4 clipFromWorld, vec2 viewport) {
  const float kInfinity = uintBitsToFloat(0x7f800000u);
  BoxOnScreen result;
  result.minWorld = vec3(kInfinity);
  result.maxWorld = vec3(-kInfinity);
  result.crossesNear = false;
  result.nearestDepth = 0.0;
  vec2 lowest = vec2(kInfinity);
  vec2 highest = vec2(-kInfinity);
  uint beyondAll = 63u;
  vec4 error = clipRounding(t, lower, upper, clipFromWorld);
  vec3 margin = error.xyz + error.w;
  for (uint corner = 0u; corner < 8u; ++corner) {
    vec3 world = transformPoint(t, boxCorner(lower, upper, corner));
    result.minWorld = min(result.minWorld, world);
    result.maxWorld = max(result.maxWorld, world);
    vec4 clip = clipFromWorld * vec4(world, 1.0);
    beyondAll &= planesBeyond(clip, margin);
    float w = clip.w - error.w;
    if (!(w > 0.0 && clip.z + margin.z < clip.w)) {
      result.crossesNear = true;
      continue;
    }
    vec2 ndc = clip.xy / clip.w;
    vec2 guard = (error.xy + abs(ndc) * error.w) / w * 0.5 * viewport;
    vec2 pixels = (ndc * 0.5 + 0.5) * viewport;
    lowest = min(lowest, pixels - guard);
    highest = max(highest, pixels + guard);
    result.nearestDepth = max(result.nearestDepth, (clip.z + error.z) / w);
  }
  result.nearestDepth *= 1.0 + kDepthSlack;
  result.outside = beyondAll != 0u;
  result.rect = vec4(clamp(lowest, vec2(0.0), viewport), clamp(highest, vec2(0.0), viewport));
  return result;
}

/// Distance from a point to the closest point of a box; 0 inside.
float distanceToBox(vec3 point, vec3 lower, vec3 upper) {
  return length(max(max(lower - point, point - upper), vec3(0.0)));
}

/// Distance from the eye to the closest point of a box, 0 inside; of an orthographic camera, from its plane along its
/// direction. @param eyeWorld, forwardWorld  as in CullView
float distanceFromEye(vec4 eyeWorld, vec4 forwardWorld, vec3 lower, vec3 upper) {
  if (forwardWorld.w == 0.0) return distanceToBox(eyeWorld.xyz, lower, upper);
  vec3 closest = min(forwardWorld.xyz * (lower - eyeWorld.xyz), forwardWorld.xyz * (upper - eyeWorld.xyz));
  return max(closest.x + closest.y + closest.z, 0.0);
}

/// Area of the sphere around a world box on the screen, pixels: that of an ellipse, pi f^2 r^2 sqrt(D^2 - r^2) /
/// (d^2 - r^2)^(3/2) with D the distance of the centre and d its depth; infinite where the sphere reaches the plane of
/// the eye. @param forwardWorld  as in CullView
float sphereArea(vec3 eyeWorld, vec4 forwardWorld, float focalPixels, BoxOnScreen box) {
  vec3 toCenter = 0.5 * (box.minWorld + box.maxWorld) - eyeWorld;
  float radius = 0.5 * length(box.maxWorld - box.minWorld);
  float size = 3.14159265 * (focalPixels * radius) * (focalPixels * radius);
  if (forwardWorld.w != 0.0) return size;
  float depth = dot(toCenter, forwardWorld.xyz);
  if (depth <= radius) return uintBitsToFloat(0x7f800000u);
  float beyond = depth * depth - radius * radius;
  return size * sqrt(max(dot(toCenter, toCenter) - radius * radius, 0.0)) / (beyond * sqrt(beyond));
}

/// Upper bound of how much a transform stretches a length: exact where the axes stay orthogonal, and never too small
/// under shear (the largest row sum of the Gram matrix bounds its largest eigenvalue).
float largestScale(Transform t) {
  vec3 x = vec3(t.worldFromObject0.x, t.worldFromObject1.x, t.worldFromObject2.x);
  vec3 y = vec3(t.worldFromObject0.y, t.worldFromObject1.y, t.worldFromObject2.y);
  vec3 z = vec3(t.worldFromObject0.z, t.worldFromObject1.z, t.worldFromObject2.z);
  float xy = abs(dot(x, y)), xz = abs(dot(x, z)), yz = abs(dot(y, z));
  return sqrt(max(max(dot(x, x) + xy + xz, dot(y, y) + xy + yz), dot(z, z) + xz + yz));
}
