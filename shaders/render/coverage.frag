// Fragments that are only covered or not. JAL_OPACITY: the occlusion pass leaves no open pixel (thesis 3.3: full
// intensity, no lighting). JAL_ID: which object a pixel shows.
// JAL_SHEET: holes of masked surfaces stay open.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/surface.glsl"

in Fragment {
#include "lib/fragment_members.glsl"
} fragment;

#ifdef JAL_ID
layout(location = 0) out uint objectNumber;  // object index + 1; 0 is the background
#else
layout(location = 0) out float openPixels;
#endif

void main() {
#ifdef JAL_SHEET
  Material material = materials[fragment.material];
  float alpha = baseColor(material, fragment.color, fragment.uv).a;
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  if (isHole(material, gl_FrontFacing, fragment.mirrored != 0u, alpha, pixel) || isFaded(fragment.fade, pixel)) discard;
#endif
#ifdef JAL_ID
  objectNumber = fragment.objectId + 1u;
#else
  openPixels = 0.0;
#endif
}
