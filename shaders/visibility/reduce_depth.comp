// One level of the farthest-depth pyramid from the one below (docs/two_phase_culling.md). Depth is reversed: farther is
// smaller. Texel (x, y) of level L stands for exactly the pixels [x << L, (x + 1) << L), clipped to the screen.
//
// JAL_FROM_DEPTH: level 1 from the depth buffer. JAL_COVERED: pixels without a surface do not count.
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

const float kNearest = 1.0;  // never the farthest: for padding, and with JAL_COVERED for pixels without a surface

float farthestOf(vec4 depths) {
#ifdef JAL_COVERED
  depths = mix(depths, vec4(kNearest), lessThanEqual(depths, vec4(0.0)));
#endif
  return min(min(depths.x, depths.y), min(depths.z, depths.w));
}

float farthestOfFour(ivec2 texel) {
  ivec2 child = 2 * texel;
#if defined(JAL_FROM_DEPTH)
  // Clamping to the edge repeats a pixel of the same four, which changes nothing.
  ivec2 screen = ivec2(reduceView.screenWidth, reduceView.screenHeight);
  if (any(greaterThanEqual(child, screen))) return kNearest;
  return farthestOf(textureGather(source, vec2(child + 1) / vec2(screen)));
#elif defined(JAL_MINMAX)
  // The corner that four texels share: the sampler's reduction takes the minimum of those with weight.
  vec2 size = vec2(textureSize(source, int(reduceView.sourceLevel)));
  return textureLod(source, vec2(child + 1) / size, float(reduceView.sourceLevel)).r;
#else
  int level = int(reduceView.sourceLevel);
  ivec2 last = textureSize(source, level) - 1;
  return farthestOf(vec4(texelFetch(source, min(child, last), level).r,
                         texelFetch(source, min(child + ivec2(1, 0), last), level).r,
                         texelFetch(source, min(child + ivec2(0, 1), last), level).r,
                         texelFetch(source, min(child + 1, last), level).r));
#endif
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(target)))) return;
  imageStore(target, texel, vec4(farthestOfFour(texel)));
}
