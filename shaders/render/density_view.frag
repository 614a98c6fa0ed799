// Shows how dense the triangles of the visible surface are: one over the area of the triangle, a logarithmic heat scale
// from kLeastDensity to kMostDensity triangles per pixel.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/palette.h"
#include "lib/surface.glsl"
#include "lib/palette.glsl"

in Fragment {
#include "lib/fragment_members.glsl"
} fragment;
flat in float areaPixels;

layout(location = 0) out vec4 frameColor;

void main() {
  Material material = materials[fragment.material];
  float alpha = baseColor(material, fragment.color, fragment.uv).a;
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  if (isHole(material, gl_FrontFacing, fragment.mirrored != 0u, alpha, pixel) || isFaded(fragment.fade, pixel)) discard;
  float area = clamp(areaPixels, 1.0 / kMostDensity, 1.0 / kLeastDensity);
  frameColor = vec4(heatColor(-log2(area * kLeastDensity) / log2(kMostDensity / kLeastDensity)), 1.0);
}
