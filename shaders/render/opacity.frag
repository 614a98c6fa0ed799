// Occlusion pass: a fragment of an occluder leaves no open pixel (thesis 3.3: full intensity, no lighting).
// JAL_SHEET: holes of masked surfaces stay open; blended surfaces never occlude.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/surface.glsl"

#ifdef JAL_SHEET
in Fragment {
  vec3 positionWorld;
  vec3 normalWorld;
  vec2 uv;
  vec4 color;
  flat vec3 tint;
  flat uint material;
  flat uint mirrored;
} fragment;
#endif

layout(location = 0) out float openPixels;

void main() {
#ifdef JAL_SHEET
  Material material = materials[fragment.material];
  bool front = gl_FrontFacing == (fragment.mirrored == 0u);
  if (!front && (material.flags & kMaterialDoubleSided) == 0u) discard;
  if ((material.flags & kMaterialBlend) != 0u) discard;
  if (isHole(material, baseColor(material, fragment.color, fragment.uv).a, uvec2(gl_FragCoord.xy))) discard;
#endif
  openPixels = 0.0;
}
