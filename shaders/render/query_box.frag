// Nothing is written; samples are counted.
//
// JAL_MASKED: only samples where the importance mask is bright enough count.
#version 450 core
#ifdef JAL_MASKED
#include "shared/limits.h"
#include "shared/frame_structs.h"
#include "shared/query_structs.h"

layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(std140, binding = kBindingSliceView) uniform SliceViewBlock { SliceView sliceView; };
layout(binding = kUnitImportance) uniform sampler2D importanceMask;

void main() {
  // The texture may be larger than the mask: its sides are powers of two.
  ivec2 size = ivec2(cullView.importanceWidth, cullView.importanceHeight);
  vec2 place = gl_FragCoord.xy / vec2(cullView.viewportWidth, cullView.viewportHeight);
  ivec2 texel = min(ivec2(place * vec2(size)), size - 1);
  if (texelFetch(importanceMask, texel, 0).r < sliceView.importance) discard;
}
#else
void main() {}
#endif
