// Shows one level of a pyramid. Default: the occlusion map; white: covered by occluders, black: open.
// JAL_DEPTH: the farthest-depth pyramid; lighter: nearer, black: nothing drawn.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/overlap.glsl"

layout(std140, binding = kBindingDrawView) uniform DrawViewBlock { DrawView drawView; };
#ifdef JAL_DEPTH
layout(binding = kUnitDepthPyramid) uniform sampler2D depthPyramid;
layout(binding = kUnitDepth) uniform sampler2D depthBuffer;
#else
layout(binding = kUnitOcclusionMap) uniform sampler2D occlusionMap;
#endif
layout(location = 0) out vec4 frameColor;

float brightness(uvec2 texel) {
#ifdef JAL_DEPTH
  float depth = drawView.mapLevel == 0u
                    ? texelFetch(depthBuffer, ivec2(texel), 0).r
                    : texelFetch(depthPyramid, ivec2(texel), int(drawView.mapLevel) - 1).r;
  return depth > 0.0 ? clamp(1.0 + log2(depth) / 16.0, 0.02, 1.0) : 0.0;  // half as bright 8 doublings further away
#else
  uint area = texelArea(texel, drawView.mapLevel, uvec2(drawView.viewportWidth, drawView.viewportHeight));
  return 1.0 - texelFetch(occlusionMap, ivec2(texel), int(drawView.mapLevel)).r / float(area);
#endif
}

void main() { frameColor = vec4(vec3(brightness(uvec2(gl_FragCoord.xy) >> drawView.mapLevel)), 1.0); }
