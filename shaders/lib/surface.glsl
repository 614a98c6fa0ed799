// Base colour and coverage of a surface point.

layout(std430, binding = kBindingMaterials) readonly buffer MaterialBlock { Material materials[]; };
#ifndef JAL_TEXTURE_CLASSES
#define JAL_TEXTURE_CLASSES 1
#endif
layout(binding = kUnitBaseColor) uniform sampler2DArray baseColorLayers[JAL_TEXTURE_CLASSES];

#if JAL_TEXTURE_CLASSES > 1
#define JAL_FETCH(CLASS) \
  case CLASS: return textureGrad(baseColorLayers[CLASS], at, dx, dy);

/// Neighbouring fragments may have textures of different classes. OpenGL 4.5 does not define a sampler that is chosen
/// by an index which differs between them, nor derivatives inside a branch: so each class has its own fetch, and the
/// derivatives are taken before.
vec4 fetchBaseColor(uint textureClass, vec3 at, vec2 dx, vec2 dy) {
  switch (int(textureClass)) {
    JAL_FETCH(0)
    JAL_FETCH(1)
#if JAL_TEXTURE_CLASSES > 2
    JAL_FETCH(2)
#endif
#if JAL_TEXTURE_CLASSES > 3
    JAL_FETCH(3)
#endif
#if JAL_TEXTURE_CLASSES > 4
    JAL_FETCH(4)
#endif
#if JAL_TEXTURE_CLASSES > 5
    JAL_FETCH(5)
#endif
#if JAL_TEXTURE_CLASSES > 6
    JAL_FETCH(6)
#endif
#if JAL_TEXTURE_CLASSES > 7
    JAL_FETCH(7)
#endif
  }
  return vec4(1.0);
}
#endif

/// Linear base colour with alpha: factor times vertex colour times texture (glTF 2.0, 3.9.2). Call it where all
/// fragments of a primitive come by: it takes derivatives.
vec4 baseColor(Material material, vec4 vertexColor, vec2 uv) {
  vec3 at = vec3(uv, material.layer);
  vec4 color = material.baseColor * vertexColor;
#if JAL_TEXTURE_CLASSES > 1
  vec2 dx = dFdx(uv);
  vec2 dy = dFdy(uv);
  if ((material.flags & kMaterialTextured) != 0u) color *= fetchBaseColor(material.textureClass, at, dx, dy);
#else
  if ((material.flags & kMaterialTextured) != 0u) color *= texture(baseColorLayers[0], at);
#endif
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
