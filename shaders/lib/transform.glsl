// Affine transforms stored as three rows.

vec3 transformPoint(Transform t, vec3 p) {
  vec4 h = vec4(p, 1.0);
  return vec3(dot(t.worldFromObject0, h), dot(t.worldFromObject1, h), dot(t.worldFromObject2, h));
}

/// Normal under the inverse transpose, not normalised: the cofactor matrix needs no division and keeps its sign
/// under mirroring, so that the result still points outwards.
vec3 transformNormal(Transform t, vec3 n) {
  vec3 c0 = cross(t.worldFromObject1.xyz, t.worldFromObject2.xyz);
  vec3 c1 = cross(t.worldFromObject2.xyz, t.worldFromObject0.xyz);
  vec3 c2 = cross(t.worldFromObject0.xyz, t.worldFromObject1.xyz);
  float handedness = dot(t.worldFromObject0.xyz, c0) < 0.0 ? -1.0 : 1.0;
  return handedness * vec3(dot(c0, n), dot(c1, n), dot(c2, n));
}

bool isMirrored(Transform t) {
  return dot(t.worldFromObject0.xyz, cross(t.worldFromObject1.xyz, t.worldFromObject2.xyz)) < 0.0;
}
