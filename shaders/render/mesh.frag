// Shades a fragment, or paints the debug view.
// JAL_SHEET: double-sided, masked and blended surfaces, mirrored and fading objects: facing and holes are decided here.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/palette.h"
#include "lib/draw_buffers.glsl"
#include "lib/surface.glsl"
#include "lib/palette.glsl"
#include "lib/shading.glsl"
#include "lib/view_ray.glsl"
#ifdef JAL_FULL_MATERIALS
#include "lib/normal_map.glsl"
#endif

in Fragment {
#include "lib/fragment_members.glsl"
} fragment;

layout(location = 0) out vec4 frameColor;
layout(location = 1) out uint objectNumber;  // object index + 1; only where the frame has an item buffer

#ifdef JAL_FULL_MATERIALS
/// The normal that a texture makes of the one that the vertices have. Call it where derivatives are defined.
vec3 shadingNormal(Material material, vec3 normal) {
  TexturePoint point = texturePoint(material.normals, fragment.uv);
  vec3 dx = dFdx(fragment.positionWorld);
  vec3 dy = dFdy(fragment.positionWorld);
  if ((material.flags & kMaterialNormalTextured) == 0u) return normal;
  vec3 mapped = (2.0 * fetchTexture(material.normals, point).rgb - 1.0) * vec3(material.emission.ww, 1.0);
  return mappedNormal(normal, mapped, point, dx, dy);
}

/// Linear. Call it where derivatives are defined.
vec3 emittedLight(Material material) {
  TexturePoint point = texturePoint(material.emissive, fragment.uv);
  vec3 light = material.emission.rgb;
  if ((material.flags & kMaterialEmissionTextured) != 0u) light *= fetchTexture(material.emissive, point).rgb;
  return light;
}
#endif

void main() {
  Material material = materials[fragment.material];
  vec4 base = baseColor(material, fragment.color, fragment.uv);
  vec3 normal = normalize(fragment.normalWorld);
#ifdef JAL_FULL_MATERIALS
  vec3 detailed = shadingNormal(material, normal);
  vec3 emitted = emittedLight(material);
#else
  vec3 detailed = normal;
  vec3 emitted = vec3(0.0);
#endif
#ifdef JAL_SHEET
  bool mirrored = fragment.mirrored != 0u;
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  if (isHole(material, gl_FrontFacing, mirrored, base.a, pixel) || isFaded(fragment.fade, pixel)) discard;
  float side = gl_FrontFacing == mirrored ? -1.0 : 1.0;
  normal *= side;
  detailed *= side;
#endif
  vec3 toEye = -normalize(viewRay(drawView.cameraWorld, drawView.forwardWorld, fragment.positionWorld));
  vec3 color;
  if (!isShadedView(drawView.view))
    color = shadeFlat(fragment.tint, normal, toEye);
  else if ((material.flags & kMaterialUnlit) != 0u)
    color = base.rgb;
  else
    color = exposed(lightFrom(base.rgb, detailed, toEye, drawView.lightWorld.xyz) + emitted);
  float opacity = drawView.view == kViewGhost ? ghostOpacity(states[fragment.objectId].verdict) : 1.0;
  frameColor = vec4(color, opacity);
  objectNumber = fragment.objectId + 1u;
}
