// Overlap test and level of visibility of the objects that classify.comp left pending (thesis 3.4, 3.5, Algorithm 3.1;
// docs/two_phase_culling.md).
//
// The opacity of a texel comes from the occlusion map by default. JAL_HOM_DEPTH: from the map, and only where the
// occluders lie in front of the object. JAL_HIZ: from a depth pyramid; a texel is covered if its farthest depth lies in
// front of the object.
// One thread: one object (one workgroup per object measured several times slower). Reads boxes, and the map or pyramid.
// Writes states, marks, and ScreenBox.cover where a view shows it or it masks errors.
// Barrier owed: SHADER_STORAGE for bin_objects.comp.
// CPU twin: src/visibility/overlap_reference.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/groups.glsl"
#include "lib/buffers.glsl"
#include "lib/overlap.glsl"
#include "lib/dct.glsl"
#include "lib/hiddenness.glsl"
#include "lib/lod.glsl"

layout(local_size_x = kObjectGroupSize) in;
/// cosines[16 * (N - 1) + i] = cos(pi (2i + 1) / 2N)
layout(std430, binding = kBindingCosines) readonly buffer CosineBlock { float cosines[]; };

#include "lib/occlusion_test.glsl"

/// The block of texels kBlockLevels below LOM that the measures look at.
struct Block {
  uvec2 x;  // first texel and count along a row
  uvec2 y;  // first row and count
  uint level;
  float nearestDepth;
};

Block blockOf(Probe probe) {
  Block block;
  block.level = probe.lom > kBlockLevels ? probe.lom - kBlockLevels : 0u;
  block.x = blockSpan(probe.pixels.x, probe.pixels.z, probe.rect.x, probe.rect.z, block.level);
  block.y = blockSpan(probe.pixels.y, probe.pixels.w, probe.rect.y, probe.rect.w, block.level);
  block.nearestDepth = probe.nearestDepth;
  return block;
}

float opacityAt(Block block, uint i, uint j) {
  return opacity(uvec2(block.x.x + i, block.y.x + j), block.level, block.nearestDepth);
}

BlockSums noSums(Block block) {
  const float kNone[3] = float[3](0.0, 0.0, 0.0);
  return BlockSums(0.0, 0.0, float[3][3](kNone, kNone, kNone), block.x.y, block.y.y);
}

/// What the measures need but the chord: rows against the cosines first, then columns.
BlockSums sumSpectrum(Block block) {
  uint cosinesX = kMaxBlockSide * (block.x.y - 1u);
  uint cosinesY = kMaxBlockSide * (block.y.y - 1u);
  BlockSums sums = noSums(block);
  vec3 low0 = vec3(0.0), low1 = vec3(0.0), low2 = vec3(0.0);
  for (uint j = 0u; j < block.y.y; ++j) {
    vec3 row = vec3(0.0);
    for (uint i = 0u; i < block.x.y; ++i) {
      float value = opacityAt(block, i, j);
      sums.covered += value;
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

/// What the chord needs.
BlockSums sumDifferences(Block block) {
  BlockSums sums = noSums(block);
  float above[kMaxBlockSide];
  for (uint j = 0u; j < block.y.y; ++j) {
    float left = 0.0;
    for (uint i = 0u; i < block.x.y; ++i) {
      float value = opacityAt(block, i, j);
      sums.covered += value;
      sums.differences += (i > 0u ? abs(value - left) : 0.0) + (j > 0u ? abs(value - above[i]) : 0.0);
      left = above[i] = value;
    }
  }
  return sums;
}

/// Covered share of the block and its mean open chord in pixels, packed into two halves.
uint measureCover(Block block) {
  const float kMostTexels = 32768.0;  // the largest power of two that a half holds
  BlockSums sums = sumDifferences(block);
  float chord = meanOpenChord(sums);
  return packHalf2x16(vec2(sums.covered / float(sums.width * sums.height),
                           (isinf(chord) ? kMostTexels : chord) * float(1u << block.level)));
}

/// Verdict and LV of one object.
struct OverlapResult {
  uint verdict;  // kVerdictOccluded, kVerdictOpen or kVerdictPartial
  float lv;
};

/// @param wantsBlock  compute LV from the block; else LV has no meaning
OverlapResult testOverlap(Probe probe, bool wantsBlock) {
  vec2 range = overlap(probe);
  if (range.x >= cullView.cullThreshold) return OverlapResult(kVerdictOccluded, 1.0);
  bool open = range.y <= 0.0;
#ifndef JAL_USES_DEPTH
  wantsBlock = wantsBlock && !open;
#endif
  if (!wantsBlock) return OverlapResult(open ? kVerdictOpen : kVerdictPartial, -1.0);
  Block block = blockOf(probe);
  BlockSums sums = noSums(block);
  if (hasTrait(kTraitLvChord)) {
    sums = sumDifferences(block);
  } else {
    sums = sumSpectrum(block);
  }
  if (sums.covered <= 0.0) return OverlapResult(kVerdictOpen, -1.0);
  return OverlapResult(kVerdictPartial, blockLv(sums, float(1u << block.level)));
}

/// What the result changes in an object: verdict, LV, phase, and where the level rule follows LV or masks errors the
/// detail of an object that is drawn late and has no count.
void applyOverlap(OverlapResult result, uint id, ScreenBox box, inout ObjectState state, inout uint mark) {
  ObjectState last = state;
  bool early = (mark & kMarkEarly) != 0u;
  bool occluded = result.verdict == kVerdictOccluded;
  bool counted = (mark & kMarkCounted) != 0u;
  bool waitsForCount = hasTrait(kTraitLvPixels) && !occluded;
  if (!counted) {
    bool remembered = (mark & kMarkRemembered) != 0u;
    state.lv = remembered ? smoothLv(last.lv, waitsForCount ? last.lv : result.lv) : result.lv;
  }
  state.verdict = occluded && early ? kVerdictStale : result.verdict;
  if (occluded) {
    mark &= ~kMarkVisible;
    return;
  }
  mark |= early ? kMarkVisible : kMarkVisible | kMarkLate;
  if (early || counted || !hasTrait(kTraitFollowsLv | kTraitMasksError)) return;
  bool known = (mark & kMarkKnown) != 0u;
  float area = (box.maxX - box.minX) * (box.maxY - box.minY);
  Chain chain = chains[objects[id].chain];
  chooseDetail(DetailInput(chain, box.pixelsPerUnit, box.tau, area, known, last, box.cover), state, mark);
}

void main() {
  uint id = threadNumber();
  if (id >= cullView.objectCount || states[id].verdict != kVerdictPending) return;
  ScreenBox box = boxes[id];
  Probe probe = probeOf(vec4(box.minX, box.minY, box.maxX, box.maxY), box.nearestDepth);
  ObjectState state = states[id];
  uint mark = marks[id];
  OverlapResult result = testOverlap(probe, cullView.analyse != 0u && (mark & kMarkCounted) == 0u);
  bool masks = hasTrait(kTraitMasksError) && result.verdict != kVerdictOccluded;
  if (masks || cullView.measureCover != 0u) boxes[id].cover = box.cover = measureCover(blockOf(probe));
  applyOverlap(result, id, box, state, mark);
  marks[id] = mark;
  states[id] = state;
}
