// One level of the occlusion map from the one below: open pixels add up (thesis 3.3; docs/occlusion_map.md).
//
// The map stores the number of open pixels, not the mean opacity: sums of whole numbers are exact in 32-bit floats up
// to 2^24 pixels, so a one-pixel hole is never rounded away and CPU and GPU agree bit for bit.
// One thread: one texel of the target. Barrier owed: SHADER_IMAGE_ACCESS for the next level, TEXTURE_FETCH for
// analyse.comp.
// CPU twin: src/visibility/occlusion_map_reference.cpp
#version 450 core
#include "shared/limits.h"

layout(local_size_x = kTexelGroupSide, local_size_y = kTexelGroupSide) in;
layout(r32f, binding = kImageSource) readonly uniform image2D source;
layout(r32f, binding = kImageTarget) writeonly uniform image2D target;

float openPixels(ivec2 texel) {
  return all(lessThan(texel, imageSize(source))) ? imageLoad(source, texel).r : 0.0;
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(target)))) return;
  ivec2 child = 2 * texel;
  float open = openPixels(child) + openPixels(child + ivec2(1, 0)) + openPixels(child + ivec2(0, 1)) +
               openPixels(child + ivec2(1, 1));
  imageStore(target, texel, vec4(open));
}
