// Textures in array textures by size. With JAL_FULL_MATERIALS, a texture has a sampler and a transform of its own; else
// it repeats, is filtered trilinearly, and has TEXCOORD_0.

#ifndef JAL_TEXTURE_CLASSES
#define JAL_TEXTURE_CLASSES 1
#endif
layout(binding = kUnitBaseColor) uniform sampler2DArray textureLayers[JAL_TEXTURE_CLASSES];

#ifdef JAL_FULL_MATERIALS
#define JAL_FETCH(CLASS) textureLod(textureLayers[CLASS], at, lod)
#define JAL_FETCH_PARAMETERS vec3 at, float lod
#else
#define JAL_FETCH(CLASS) textureGrad(textureLayers[CLASS], at, dx, dy)
#define JAL_FETCH_PARAMETERS vec3 at, vec2 dx, vec2 dy
#endif

/// Neighbouring fragments may have textures of different classes. OpenGL 4.5 does not define a sampler that is chosen
/// by an index which differs between them, nor derivatives inside a branch: so each class has its own fetch, and the
/// derivatives are taken before.
vec4 fetchLayer(uint textureClass, JAL_FETCH_PARAMETERS) {
  switch (int(textureClass)) {
    case 0: return JAL_FETCH(0);
#if JAL_TEXTURE_CLASSES > 1
    case 1: return JAL_FETCH(1);
#endif
#if JAL_TEXTURE_CLASSES > 2
    case 2: return JAL_FETCH(2);
#endif
#if JAL_TEXTURE_CLASSES > 3
    case 3: return JAL_FETCH(3);
#endif
#if JAL_TEXTURE_CLASSES > 4
    case 4: return JAL_FETCH(4);
#endif
#if JAL_TEXTURE_CLASSES > 5
    case 5: return JAL_FETCH(5);
#endif
#if JAL_TEXTURE_CLASSES > 6
    case 6: return JAL_FETCH(6);
#endif
#if JAL_TEXTURE_CLASSES > 7
    case 7: return JAL_FETCH(7);
#endif
  }
  return vec4(1.0);
}

/// Where a texture is read.
struct TexturePoint {
  vec2 at;
  vec2 dx;  // derivatives along the screen's axes
  vec2 dy;
};

#ifdef JAL_FULL_MATERIALS

/// Call it where all fragments of a primitive come by: it takes derivatives.
TexturePoint texturePoint(TextureUse use, vec4 uv) {
  bool second = (use.sampling & kSamplingSecondUv) != 0u;
  mat2 axes = mat2(use.uvAxes.xy, use.uvAxes.zw);
  vec4 dx = dFdx(uv);
  vec4 dy = dFdy(uv);
  return TexturePoint(axes * (second ? uv.zw : uv.xy) + use.uvOffset, axes * (second ? dx.zw : dx.xy),
                      axes * (second ? dy.zw : dy.xy));
}

/// A coordinate within the layer. @param border  half a texel of the coarsest mip level that is read, at most 1/2
float wrapped(float coordinate, bool clamps, bool mirrors, float border) {
  if (mirrors) coordinate = 1.0 - abs(1.0 - 2.0 * fract(0.5 * coordinate));
  return clamps || mirrors ? clamp(coordinate, border, 1.0 - border) : coordinate;
}

/// A texel by the sampler of its texture: the wrap modes and filters of glTF 2.0, 3.8.4, made of a repeating trilinear
/// sampler. Nearest filters read the centre of a texel of one mip level.
vec4 fetchTexture(TextureUse use, TexturePoint point) {
  uint bits = use.sampling;
  vec2 size = exp2(vec2((bits >> kSamplingWidthShift) & 31u, (bits >> kSamplingHeightShift) & 31u));
  vec2 dx = point.dx * size;
  vec2 dy = point.dy * size;
  float lod = max(0.5 * log2(max(max(dot(dx, dx), dot(dy, dy)), 1e-20)), -64.0);
  bool nearest = (bits & (lod <= 0.0 ? kSamplingMagnifyNearest : kSamplingMinifyNearest)) != 0u;
  lod = clamp((bits & kSamplingMipNone) != 0u ? 0.0 : lod, 0.0, log2(max(size.x, size.y)));
  if (nearest || (bits & kSamplingMipNearest) != 0u) lod = floor(lod + 0.5);
  vec2 texels = max(size * exp2(-ceil(lod)), 1.0);
  vec2 at = vec2(wrapped(point.at.x, (bits & kSamplingClampU) != 0u, (bits & kSamplingMirrorU) != 0u, 0.5 / texels.x),
                 wrapped(point.at.y, (bits & kSamplingClampV) != 0u, (bits & kSamplingMirrorV) != 0u, 0.5 / texels.y));
  if (nearest) at = (floor(at * texels) + 0.5) / texels;
  return fetchLayer(use.place >> 16u, vec3(at, float(use.place & 0xffffu)), lod);
}

#else

TexturePoint texturePoint(TextureUse use, vec2 uv) { return TexturePoint(uv, dFdx(uv), dFdy(uv)); }

vec4 fetchTexture(TextureUse use, TexturePoint point) {
  vec3 at = vec3(point.at, float(use.place & 0xffffu));
#if JAL_TEXTURE_CLASSES > 1
  return fetchLayer(use.place >> 16u, at, point.dx, point.dy);
#else
  return texture(textureLayers[0], at);
#endif
}

#endif
