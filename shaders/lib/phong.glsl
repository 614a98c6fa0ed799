// Phong tessellation (Boubekeur and Alexa 2008): pull a point of the flat triangle towards the corners' tangent planes.
// CPU twin: src/scene/patch_base.cpp

/// Projection of p onto the plane through origin with unit normal n.
vec3 projectOntoPlane(vec3 p, vec3 origin, vec3 n) { return p - dot(p - origin, n) * n; }

/// @param b  barycentric coordinates, sum 1   @param alpha  0 flat, 1 fully projected
vec3 phongPoint(vec3 b, vec3 corners[3], vec3 normals[3], float alpha) {
  vec3 flatPoint = b.x * corners[0] + b.y * corners[1] + b.z * corners[2];
  vec3 curved = b.x * projectOntoPlane(flatPoint, corners[0], normals[0]) +
                b.y * projectOntoPlane(flatPoint, corners[1], normals[1]) +
                b.z * projectOntoPlane(flatPoint, corners[2], normals[2]);
  return mix(flatPoint, curved, alpha);
}
