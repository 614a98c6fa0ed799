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
  vec2 place = gl_FragCoord.xy / vec2(cullView.viewportWidth, cullView.viewportHeight);
  if (textureLod(importanceMask, place, 0.0).r < sliceView.importance) discard;
}
#else
void main() {}
#endif
