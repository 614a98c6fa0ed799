// Affine transforms stored as three rows.

vec3 transformPoint(vec4 row0, vec4 row1, vec4 row2, vec3 p) {
  vec4 h = vec4(p, 1.0);
  return vec3(dot(row0, h), dot(row1, h), dot(row2, h));
}

/// Normal under the inverse transpose, not normalised: the cofactor matrix needs no division and keeps its sign
/// under mirroring, so that the result still points outwards.
vec3 transformNormal(vec4 row0, vec4 row1, vec4 row2, vec3 n) {
  vec3 c0 = cross(row1.xyz, row2.xyz);
  vec3 c1 = cross(row2.xyz, row0.xyz);
  vec3 c2 = cross(row0.xyz, row1.xyz);
  float handedness = dot(row0.xyz, c0) < 0.0 ? -1.0 : 1.0;
  return handedness * vec3(dot(c0, n), dot(c1, n), dot(c2, n));
}
