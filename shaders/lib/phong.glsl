// Phong tessellation (Boubekeur and Alexa 2008): pull a point of the flat triangle towards the corners' tangent planes.
// CPU twin: src/scene/patch_base.cpp

/// Projection of p onto the plane through origin with unit normal n.
vec3 projectOntoPlane(vec3 p, vec3 origin, vec3 n) { return p - dot(p - origin, n) * n; }

/// @param b  barycentric coordinates, sum 1   @param alpha  0 flat, 1 fully projected
vec3 phongPoint(vec3 b, vec3 p0, vec3 p1, vec3 p2, vec3 n0, vec3 n1, vec3 n2, float alpha) {
  vec3 flatPoint = b.x * p0 + b.y * p1 + b.z * p2;
  vec3 curved = b.x * projectOntoPlane(flatPoint, p0, n0) + b.y * projectOntoPlane(flatPoint, p1, n1) +
                b.z * projectOntoPlane(flatPoint, p2, n2);
  return mix(flatPoint, curved, alpha);
}
