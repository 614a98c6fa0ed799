// One level of the farthest-depth pyramid from the one below (docs/two_phase_culling.md). Depth is reversed: farther is
// smaller. Texel (x, y) of level L stands for exactly the pixels [x << L, (x + 1) << L), clipped to the screen.
//
// JAL_FROM_DEPTH: level 1 from the depth buffer. JAL_COVERED: pixels that nothing covers do not count.
// JAL_MINMAX: the minimum of four texels through a sampler (ARB_texture_filter_minmax) instead of four fetches.
// One thread: one texel of the target. Barrier owed: TEXTURE_FETCH for the next level and for analyse.comp.
// CPU twin: src/visibility/depth_pyramid_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"

layout(local_size_x = kTexelGroupSide, local_size_y = kTexelGroupSide) in;
layout(std140, binding = kBindingReduceView) uniform ReduceViewBlock { ReduceView reduceView; };
layout(binding = kUnitDepth) uniform sampler2D source;
layout(r32f, binding = kImageTarget) writeonly uniform image2D target;

const float kNearest = 1.0;  // never the farthest: padding, and with JAL_COVERED what is open

#if defined(JAL_FROM_DEPTH)
float fetchDepth(ivec2 texel) {
  if (any(greaterThanEqual(texel, ivec2(reduceView.screenWidth, reduceView.screenHeight)))) return kNearest;
  float depth = texelFetch(source, texel, 0).r;
#ifdef JAL_COVERED
  if (depth <= 0.0) return kNearest;
#endif
  return depth;
}
#else
float fetchDepth(ivec2 texel) {
  return texelFetch(source, min(texel, textureSize(source, int(reduceView.sourceLevel)) - 1), int(reduceView.sourceLevel)).r;
}
#endif

float farthestOfFour(ivec2 texel) {
#if defined(JAL_MINMAX) && !defined(JAL_FROM_DEPTH)
  // The corner that four texels share: the sampler's reduction takes the minimum of those with weight.
  vec2 size = vec2(textureSize(source, int(reduceView.sourceLevel)));
  return textureLod(source, vec2(2 * texel + 1) / size, float(reduceView.sourceLevel)).r;
#else
  ivec2 child = 2 * texel;
  return min(min(fetchDepth(child), fetchDepth(child + ivec2(1, 0))),
             min(fetchDepth(child + ivec2(0, 1)), fetchDepth(child + ivec2(1, 1))));
#endif
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(target)))) return;
  imageStore(target, texel, vec4(farthestOfFour(texel)));
}
