// The attributes of a vertex of the scene.
#include "lib/texture_coordinates.glsl"

layout(location = kAttributePosition) in vec3 position;
layout(location = kAttributeNormal) in vec4 normal;
layout(location = kAttributeUv) in vec2 uv;
#ifdef JAL_FULL_MATERIALS
layout(location = kAttributeUv1) in vec2 uv1;
#endif
layout(location = kAttributeColor) in vec4 color;
layout(location = kAttributeMaterial) in uint material;

TextureCoordinates textureCoordinates() {
#ifdef JAL_FULL_MATERIALS
  return vec4(uv, uv1);
#else
  return uv;
#endif
}
