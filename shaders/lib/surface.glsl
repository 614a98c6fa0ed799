// Base colour and coverage of a surface point.
#include "lib/texture_coordinates.glsl"
#include "lib/textures.glsl"

layout(std430, binding = kBindingMaterials) readonly buffer MaterialBlock { Material materials[]; };

/// Linear base colour with alpha: factor times vertex colour times texture (glTF 2.0, 3.9.2). Call it where all
/// fragments of a primitive come by: it takes derivatives.
vec4 baseColor(Material material, vec4 vertexColor, TextureCoordinates uv) {
  vec4 color = material.baseColor * vertexColor;
  TexturePoint point = texturePoint(material.base, uv);
  if ((material.flags & kMaterialTextured) != 0u) color *= fetchTexture(material.base, point);
  return color;
}

/// Threshold of a 4x4 ordered dither, in (0, 1): blending without sorting, the same in every frame.
float ditherThreshold(uvec2 pixel) {
  uint x = pixel.x & 3u, y = pixel.y & 3u;
  uint q = x ^ y;
  uint rank = ((q & 1u) << 3u) | ((y & 1u) << 2u) | ((q & 2u)) | ((y & 2u) >> 1u);
  return (float(rank) + 0.5) / 16.0;
}

/// Whether nothing is drawn here: the back of a single-sided surface, or a hole that alpha leaves.
/// @param front  as the rasteriser says   @param mirrored  the object's transform turns fronts into backs
bool isHole(Material material, bool front, bool mirrored, float alpha, uvec2 pixel) {
  if (front == mirrored && (material.flags & kMaterialDoubleSided) == 0u) return true;
  if ((material.flags & kMaterialMask) != 0u) return alpha < material.alphaCutoff;
  if ((material.flags & kMaterialBlend) != 0u) return alpha < ditherThreshold(pixel);
  return false;
}

/// Whether a pixel belongs to the other level of a cross-fade. @param fade  the level's share, negative if it goes
bool isFaded(float fade, uvec2 pixel) {
  float threshold = ditherThreshold(pixel);
  return fade > 0.0 ? threshold > fade : fade < 0.0 && threshold <= 1.0 + fade;
}
