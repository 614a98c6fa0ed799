// Shows one level of the occlusion map: white = covered by occluders, black = open.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/overlap.glsl"

layout(std140, binding = kBindingDrawView) uniform DrawViewBlock { DrawView drawView; };
layout(binding = kUnitOcclusionMap) uniform sampler2D occlusionMap;
layout(location = 0) out vec4 frameColor;

void main() {
  uvec2 texel = uvec2(gl_FragCoord.xy) >> drawView.mapLevel;
  uint area = texelArea(texel, drawView.mapLevel, uvec2(drawView.viewportWidth, drawView.viewportHeight));
  float open = texelFetch(occlusionMap, ivec2(texel), int(drawView.mapLevel)).r / float(area);
  frameColor = vec4(vec3(1.0 - open), 1.0);
}
