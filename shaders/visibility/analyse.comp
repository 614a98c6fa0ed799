// Overlap test and frequency analysis of the occludees against the occlusion map (thesis 3.4, 3.5, Algorithm 3.1).
//
// One thread: one object (one workgroup per object measured several times slower). Reads rects and the map.
// Writes states (verdict, lv). Barrier owed: SHADER_STORAGE for emit_commands.comp.
// CPU twin: src/visibility/overlap_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/buffers.glsl"
#include "lib/overlap.glsl"
#include "lib/dct.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(binding = kUnitOcclusionMap) uniform sampler2D occlusionMap;
/// cosines[16 * (N - 1) + i] = cos(pi (2i + 1) / 2N)
layout(std430, binding = kBindingCosines) readonly buffer CosineBlock { float cosines[]; };

uvec2 viewport() { return uvec2(cullView.viewportWidth, cullView.viewportHeight); }

/// Opacity of a texel: the covered share of the pixels it stands for.
float opacity(uvec2 texel, uint level) {
  return 1.0 - texelFetch(occlusionMap, ivec2(texel), int(level)).r / float(texelArea(texel, level, viewport()));
}

/// Lowest and highest opacity of the texels that a pixel span touches at a level.
vec2 opacityRange(uvec4 pixels, uint level) {
  uvec4 texels = pixels >> level;
  vec2 range = vec2(1.0, 0.0);
  for (uint y = texels.y; y <= texels.w; ++y) {
    for (uint x = texels.x; x <= texels.z; ++x) {
      float value = opacity(uvec2(x, y), level);
      range = vec2(min(range.x, value), max(range.y, value));
    }
  }
  return range;
}

/// Normalised LV of the block kBlockLevels below LOM, rows first, then columns: 2 NM + 4 M multiply-adds.
float analyseBlock(uvec4 pixels, vec4 rect, uint lom) {
  uint level = lom > kBlockLevels ? lom - kBlockLevels : 0u;
  uvec2 spanX = blockSpan(pixels.x, pixels.z, rect.x, rect.z, level);
  uvec2 spanY = blockSpan(pixels.y, pixels.w, rect.y, rect.w, level);
  bool spectrum = max(spanX.y, spanY.y) >= kMinSpectrumSide;
  uint cosinesX = 16u * (spanX.y - 1u);
  uint cosinesY = 16u * (spanY.y - 1u);
  float dc = 0.0, u = 0.0, v = 0.0, uv = 0.0;
  for (uint j = 0u; j < spanY.y; ++j) {
    float rowSum = 0.0, rowCosine = 0.0;
    for (uint i = 0u; i < spanX.y; ++i) {
      float f = opacity(uvec2(spanX.x + i, spanY.x + j), level) - 0.5;
      rowSum += f;
      rowCosine += f * cosines[cosinesX + i];
    }
    float c = cosines[cosinesY + j];
    dc += rowSum;
    u += rowCosine;
    v += rowSum * c;
    uv += rowCosine * c;
  }
  if (!spectrum) u = v = uv = 0.0;
  return levelOfVisibility(dc, u, v, uv, spanX.y, spanY.y);
}

void main() {
  uint id = gl_GlobalInvocationID.x;
  if (id >= cullView.objectCount || states[id].verdict != kVerdictPending) return;
  vec4 rect = vec4(rects[id].minX, rects[id].minY, rects[id].maxX, rects[id].maxY);
  uvec4 pixels = touchedPixels(rect, viewport());
  uint lom = min(levelForExtent(max(rect.z - rect.x, rect.w - rect.y)), cullView.mapLevels - 1u);

  // Cull if some level, from LOM down, shows every touched texel covered.
  uint lowest = lom > kMaxDescent ? lom - kMaxDescent : 0u;
  vec2 range = opacityRange(pixels, lom);
  bool open = range.y <= 0.0;
  for (uint level = lom; range.x < cullView.cullThreshold && level > lowest && range.y > 0.0;) {
    range = opacityRange(pixels, --level);
    open = range.y <= 0.0;
  }
  if (range.x >= cullView.cullThreshold) {
    states[id].verdict = kVerdictOccluded;
    states[id].lv = 1.0;
  } else if (open) {
    states[id].verdict = kVerdictOpen;
  } else {
    states[id].verdict = kVerdictPartial;
    if (cullView.analyse != 0u) states[id].lv = analyseBlock(pixels, rect, lom);
  }
}
