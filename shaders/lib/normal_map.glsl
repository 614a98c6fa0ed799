// Normals of a texture, without tangents in the vertices (Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on the
// GPU"; here with a normal in place of a height).

/// Direction of a normal of tangent space. The axes follow from how position and texture coordinates change from
/// fragment to fragment; +y of the texture points against v (glTF 2.0, 3.9.3).
/// @param normal  unit, world   @param mapped  normal in tangent space
/// @param dx      derivatives of the world position along the screen's axes   @return  unit, world
vec3 mappedNormal(vec3 normal, vec3 mapped, TexturePoint point, vec3 dx, vec3 dy) {
  vec3 acrossY = cross(dy, normal);
  vec3 acrossX = cross(normal, dx);
  vec3 tangent = acrossY * point.dx.x + acrossX * point.dy.x;
  vec3 bitangent = -(acrossY * point.dx.y + acrossX * point.dy.y);
  float longest = max(dot(tangent, tangent), dot(bitangent, bitangent));
  if (!(longest > 0.0)) return normal;
  // The determinant of dx and dy on the surface is negative where the surface is seen from behind.
  float scale = inversesqrt(longest) * sign(dot(cross(dx, dy), normal));
  vec3 sum = (tangent * mapped.x + bitangent * mapped.y) * scale + normal * mapped.z;
  float size = dot(sum, sum);
  return size > 0.0 ? sum * inversesqrt(size) : normal;
}
