// Overlap test and frequency analysis of the occludees (thesis 3.4, 3.5, Algorithm 3.1; docs/two_phase_culling.md).
//
// What hides is (default) the opacity of the occlusion map, JAL_HOM_DEPTH: the same where the occluders lie in front of
// the object, JAL_HIZ: a depth pyramid, where a texel covers if its farthest depth lies in front of the object.
// One thread: one object (one workgroup per object measured several times slower). Reads boxes and the map.
// Writes states, marks, and the boxes' cover where a view shows it. Barrier owed: SHADER_STORAGE for bin_objects.comp.
// CPU twin: src/visibility/overlap_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/buffers.glsl"
#include "lib/overlap.glsl"
#include "lib/dct.glsl"
#include "lib/hiddenness.glsl"
#include "lib/lod.glsl"

layout(local_size_x = kObjectGroupSize) in;
/// cosines[16 * (N - 1) + i] = cos(pi (2i + 1) / 2N)
layout(std430, binding = kBindingCosines) readonly buffer CosineBlock { float cosines[]; };

#ifndef JAL_HIZ
layout(binding = kUnitOcclusionMap) uniform sampler2D occlusionMap;
#endif
#if defined(JAL_HIZ) || defined(JAL_HOM_DEPTH)
#define JAL_DEPTH_AWARE
layout(binding = kUnitDepthPyramid) uniform sampler2D depthPyramid;  // level L of the screen is its level L - 1
layout(binding = kUnitDepth) uniform sampler2D depthBuffer;
#endif

uvec2 viewport() { return uvec2(cullView.viewportWidth, cullView.viewportHeight); }

/// The covered share of the pixels that a texel stands for, as an object at a depth sees it.
float opacity(uvec2 texel, uint level, float nearestDepth) {
  float covered = 1.0;
#ifdef JAL_DEPTH_AWARE
  float farthest = level == 0u ? texelFetch(depthBuffer, ivec2(texel), 0).r
                               : texelFetch(depthPyramid, ivec2(texel), int(level) - 1).r;
  if (!(farthest > nearestDepth)) return 0.0;
#endif
#ifndef JAL_HIZ
  covered -= texelFetch(occlusionMap, ivec2(texel), int(level)).r / float(texelArea(texel, level, viewport()));
#endif
  return covered;
}

/// Lowest and highest opacity of the texels that a pixel span touches at a level.
vec2 opacityRange(uvec4 pixels, uint level, float nearestDepth) {
  uvec4 texels = pixels >> level;
  vec2 range = vec2(1.0, 0.0);
  for (uint y = texels.y; y <= texels.w; ++y) {
    for (uint x = texels.x; x <= texels.z; ++x) {
      float value = opacity(uvec2(x, y), level, nearestDepth);
      range = vec2(min(range.x, value), max(range.y, value));
    }
  }
  return range;
}

/// The sums of the block kBlockLevels below LOM that the measure needs, rows first, then columns.
BlockSums sumBlock(uvec4 pixels, vec4 rect, uint level, float nearestDepth) {
  uvec2 spanX = blockSpan(pixels.x, pixels.z, rect.x, rect.z, level);
  uvec2 spanY = blockSpan(pixels.y, pixels.w, rect.y, rect.w, level);
  uint cosinesX = 16u * (spanX.y - 1u);
  uint cosinesY = 16u * (spanY.y - 1u);
  bool wantsChord = hasTrait(kTraitLvChord);
  BlockSums sums;
  sums.width = spanX.y;
  sums.height = spanY.y;
  sums.covered = sums.differences = 0.0;
  vec3 low0 = vec3(0.0), low1 = vec3(0.0), low2 = vec3(0.0);
  float above[kMaxBlockSide];
  for (uint j = 0u; j < spanY.y; ++j) {
    vec3 row = vec3(0.0);
    float left = 0.0;
    for (uint i = 0u; i < spanX.y; ++i) {
      float value = opacity(uvec2(spanX.x + i, spanY.x + j), level, nearestDepth);
      sums.covered += value;
      if (wantsChord) {
        sums.differences += (i > 0u ? abs(value - left) : 0.0) + (j > 0u ? abs(value - above[i]) : 0.0);
        left = above[i] = value;
        continue;
      }
      float c = cosines[cosinesX + i];
      row += (value - 0.5) * vec3(1.0, c, 2.0 * c * c - 1.0);  // cos 2a from cos a
    }
    float c = cosines[cosinesY + j];
    low0 += row;
    low1 += row * c;
    low2 += row * (2.0 * c * c - 1.0);
  }
  sums.low = float[3][3](float[3](low0.x, low0.y, low0.z), float[3](low1.x, low1.y, low1.z),
                         float[3](low2.x, low2.y, low2.z));
  return sums;
}

/// Covered share of the block and its mean open chord in pixels, packed: what the views of cover show.
uint measureCover(uvec4 pixels, vec4 rect, uint level, float nearestDepth) {
  uvec2 spanX = blockSpan(pixels.x, pixels.z, rect.x, rect.z, level);
  uvec2 spanY = blockSpan(pixels.y, pixels.w, rect.y, rect.w, level);
  float covered = 0.0, differences = 0.0;
  float above[kMaxBlockSide];
  for (uint j = 0u; j < spanY.y; ++j) {
    float left = 0.0;
    for (uint i = 0u; i < spanX.y; ++i) {
      float value = opacity(uvec2(spanX.x + i, spanY.x + j), level, nearestDepth);
      covered += value;
      differences += (i > 0u ? abs(value - left) : 0.0) + (j > 0u ? abs(value - above[i]) : 0.0);
      left = above[i] = value;
    }
  }
  return packHalf2x16(vec2(covered / float(spanX.y * spanY.y),
                           meanOpenChord(covered, differences, spanX.y, spanY.y) * float(1u << level)));
}

/// Lowest opacity over the rectangle at LOM and up to kMaxDescent levels below, and whether nothing at all covers it.
vec2 overlap(uvec4 pixels, uint lom, float nearestDepth) {
  uint lowest = lom > kMaxDescent ? lom - kMaxDescent : 0u;
  vec2 range = opacityRange(pixels, lom, nearestDepth);
  for (uint level = lom; range.x < cullView.cullThreshold && level > lowest;) {
#ifndef JAL_DEPTH_AWARE
    if (range.y <= 0.0) break;  // a sum of nothing: the levels below are open too. Not so for a farthest depth
#endif
    range = opacityRange(pixels, --level, nearestDepth);
  }
  return range;
}

void main() {
  uint id = gl_GlobalInvocationID.x;
  if (id >= cullView.objectCount || states[id].verdict != kVerdictPending) return;
  ScreenBox box = boxes[id];
  vec4 rect = vec4(box.minX, box.minY, box.maxX, box.maxY);
#ifdef JAL_HOM_DEPTH
  // The map was drawn with levels that may be off by occluderTau pixels.
  float guard = ceil(cullView.occluderTau);
  rect = clamp(rect + vec4(-guard, -guard, guard, guard), vec4(0.0), vec4(viewport().xyxy));
#endif
  uvec4 pixels = touchedPixels(rect, viewport());
  uint lom = min(levelForExtent(max(rect.z - rect.x, rect.w - rect.y)), cullView.mapLevels - 1u);
  vec2 range = overlap(pixels, lom, box.nearestDepth);

  ObjectState last = states[id];
  ObjectState state = last;
  uint mark = marks[id];
  bool known = (mark & kMarkKnown) != 0u;
  bool counted = (mark & kMarkCounted) != 0u;
  bool remembered = (mark & kMarkRemembered) != 0u;
  bool hidden = range.x >= cullView.cullThreshold;
  bool open = !hidden && range.y <= 0.0;
  bool waitsForCount = hasTrait(kTraitLvPixels) && !hidden;
  float lv = hidden ? 1.0 : -1.0;
  bool wantsBlock = !hidden && !counted && cullView.analyse != 0u;
#ifndef JAL_DEPTH_AWARE
  wantsBlock = wantsBlock && !open;
#endif
  if (wantsBlock) {
    uint level = lom > kBlockLevels ? lom - kBlockLevels : 0u;
    BlockSums sums = sumBlock(pixels, rect, level, box.nearestDepth);
    open = sums.covered <= 0.0;
    if (!open) lv = blockLv(sums, float(1u << level));
  }
  if (!counted) state.lv = remembered ? smoothLv(last.lv, waitsForCount ? last.lv : lv) : lv;

  if (cullView.measureCover != 0u)
    boxes[id].cover = measureCover(pixels, rect, lom > kBlockLevels ? lom - kBlockLevels : 0u, box.nearestDepth);

  bool early = (mark & kMarkEarly) != 0u;
  state.verdict = hidden ? (early ? kVerdictStale : kVerdictOccluded) : open ? kVerdictOpen : kVerdictPartial;
  if (hidden) {
    mark &= ~kMarkVisible;
  } else {
    mark |= early ? kMarkVisible : kMarkVisible | kMarkLate;
  }
  if (!early && !hidden && !counted && hasTrait(kTraitFollowsLv))
    chooseDetail(chains[objects[id].chain], box.pixelsPerUnit, box.tau, known, last, state, mark);
  marks[id] = mark;
  states[id] = state;
}
