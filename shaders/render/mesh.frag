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

in Fragment {
#include "lib/fragment_members.glsl"
} fragment;

layout(location = 0) out vec4 frameColor;
layout(location = 1) out uint objectNumber;  // object index + 1; only where the frame has an item buffer

void main() {
  Material material = materials[fragment.material];
  vec4 base = baseColor(material, fragment.color, fragment.uv);
  vec3 normal = normalize(fragment.normalWorld);
#ifdef JAL_SHEET
  bool mirrored = fragment.mirrored != 0u;
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  if (isHole(material, gl_FrontFacing, mirrored, base.a, pixel) || isFaded(fragment.fade, pixel)) discard;
  if (gl_FrontFacing == mirrored) normal = -normal;
#endif
  vec3 toEye = normalize(drawView.cameraWorld.xyz - fragment.positionWorld);
  vec3 color = isShadedView(drawView.view) ? shade(base.rgb, normal, toEye, drawView.lightWorld.xyz)
                                            : shadeFlat(fragment.tint, normal, toEye);
  float opacity = drawView.view == kViewGhost ? ghostOpacity(states[fragment.objectId].verdict) : 1.0;
  frameColor = vec4(color, opacity);
  objectNumber = fragment.objectId + 1u;
}
