// Shows how many surfaces were drawn on each pixel: black for none, then a logarithmic heat scale from 1 to
// kOverdrawScale.
#version 450 core
#include "shared/limits.h"
#include "shared/frame_structs.h"
#include "shared/palette.h"
#include "lib/palette.glsl"

layout(binding = kUnitOcclusionMap) uniform sampler2D halvings;  // 2^-surfaces
layout(location = 0) out vec4 frameColor;

void main() {
  float surfaces = -log2(max(texelFetch(halvings, ivec2(gl_FragCoord.xy), 0).r, 1e-37));
  float share = log2(max(surfaces, 1.0)) / log2(kOverdrawScale);
  frameColor = vec4(surfaces > 0.5 ? heatColor(min(share, 1.0)) : vec3(0.0), 1.0);
}
