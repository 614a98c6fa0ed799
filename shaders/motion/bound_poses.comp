// Boxes of bent chains, from the boxes of the vertices that each joint influences: a bent vertex is a sum of the places
// where its joints alone would put it, weighted by its influences.
//
// One workgroup: one chain. Reads bentChains, bentBoxes, deltaBoxes, weights, joints. Writes the boxes of chains, and
// those of the cell that the chain is where the scene has cells. Barrier owed: SHADER_STORAGE for all kernels that read
// chains or bounds of cells. CPU twin: src/scene/motion_state.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/motion_structs.h"
#include "lib/groups.glsl"
#include "lib/transform.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingMotionView) uniform MotionViewBlock { MotionView motionView; };
layout(std430, binding = kBindingMovedChains) buffer MovedChainBlock { Chain chains[]; };
layout(std430, binding = kBindingMovedCellChains) buffer MovedCellChainBlock { Chain cellChains[]; };
layout(std430, binding = kBindingBentBoxes) readonly buffer BentBoxBlock { BentBox bentBoxes[]; };
layout(std430, binding = kBindingBentChains) readonly buffer BentChainBlock { BentChain bentChains[]; };
layout(std430, binding = kBindingDeltaBoxes) readonly buffer DeltaBoxBlock { CellBounds deltaBoxes[]; };
layout(std430, binding = kBindingWeights) readonly buffer WeightBlock { float weights[]; };
layout(std430, binding = kBindingJoints) readonly buffer JointBlock { Transform joints[]; };
layout(std430, binding = kBindingMovedCellBounds) writeonly buffer MovedCellBoundsBlock { CellBounds cellBounds[]; };

struct Box {
  vec3 low;
  vec3 high;
};

shared vec3 lows[kObjectGroupSize];
shared vec3 highs[kObjectGroupSize];
shared float scales[kObjectGroupSize];

Box scaled(Box box, float factor) {
  vec3 a = factor * box.low;
  vec3 b = factor * box.high;
  return Box(min(a, b), max(a, b));
}

/// One row of the box of a transformed box, widened by the rounding of a vertex in it.
vec2 rowRange(vec4 row, Box box) {
  vec3 a = row.xyz * box.low;
  vec3 b = row.xyz * box.high;
  vec3 least = min(a, b);
  vec3 most = max(a, b);
  vec3 size = max(abs(a), abs(b));
  float rounding = kBentRounding * (size.x + size.y + size.z + abs(row.w));
  return vec2(least.x + least.y + least.z + row.w - rounding, most.x + most.y + most.z + row.w + rounding);
}

Box posed(BentBox entry) {
  Box box = Box(entry.minObject.xyz, entry.maxObject.xyz);
  vec3 size = max(abs(box.low), abs(box.high));
  for (uint t = 0u; t < entry.targetCount; ++t) {
    CellBounds delta = deltaBoxes[entry.firstDelta + t];
    Box part = scaled(Box(delta.minObject.xyz, delta.maxObject.xyz), weights[entry.firstWeight + t]);
    box = Box(box.low + part.low, box.high + part.high);
    size += max(abs(part.low), abs(part.high));
  }
  box = Box(box.low - kBentRounding * size, box.high + kBentRounding * size);
  if (entry.joint == kNoMotion) return box;
  Transform joint = joints[entry.joint];
  vec2 x = rowRange(joint.worldFromObject0, box);
  vec2 y = rowRange(joint.worldFromObject1, box);
  vec2 z = rowRange(joint.worldFromObject2, box);
  return Box(vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y));
}

/// Bound of the factor by which lengths grow.
float scaleOf(BentBox entry) {
  if (entry.joint == kNoMotion) return 1.0;
  Transform joint = joints[entry.joint];
  return sqrt(dot(joint.worldFromObject0.xyz, joint.worldFromObject0.xyz) +
              dot(joint.worldFromObject1.xyz, joint.worldFromObject1.xyz) +
              dot(joint.worldFromObject2.xyz, joint.worldFromObject2.xyz));
}

/// @param low, high  over all boxes of the chain   @param scale  largest one of its joints
void store(BentChain bent, vec3 low, vec3 high, float scale) {
  Box least = scaled(Box(low, high), bent.leastSum);
  Box most = scaled(Box(low, high), bent.mostSum);
  // An edge is as long as its joints make it, and longer where its ends follow different joints.
  float bulge = bent.bulge * (scale * bent.longestEdge + bent.weightStep * length(high - low));
  vec4 boxMin = vec4(min(least.low, most.low) - bulge, 0.0);
  vec4 boxMax = vec4(max(least.high, most.high) + bulge, 0.0);
  chains[bent.chain].boundsMinObject = boxMin;
  chains[bent.chain].boundsMaxObject = boxMax;
  if (bent.cellChain == kNoMotion) return;
  cellChains[bent.cellChain].boundsMinObject = boxMin;
  cellChains[bent.cellChain].boundsMaxObject = boxMax;
  for (uint lod = 0u; lod < bent.cellLodCount; ++lod)
    cellBounds[bent.firstCellLod + lod] = CellBounds(boxMin, boxMax);
}

void main() {
  if (groupNumber() >= motionView.chainCount) return;
  BentChain bent = bentChains[groupNumber()];
  uint lane = gl_LocalInvocationID.x;
  Box first = posed(bentBoxes[bent.firstBox]);
  vec3 low = first.low;
  vec3 high = first.high;
  float scale = 0.0;
  for (uint i = lane; i < bent.boxCount; i += kObjectGroupSize) {
    Box box = posed(bentBoxes[bent.firstBox + i]);
    low = min(low, box.low);
    high = max(high, box.high);
    scale = max(scale, scaleOf(bentBoxes[bent.firstBox + i]));
  }
  lows[lane] = low;
  highs[lane] = high;
  scales[lane] = scale;
  for (uint width = kObjectGroupSize / 2u; width > 0u; width /= 2u) {
    barrier();
    if (lane >= width) continue;
    lows[lane] = min(lows[lane], lows[lane + width]);
    highs[lane] = max(highs[lane], highs[lane + width]);
    scales[lane] = max(scales[lane], scales[lane + width]);
  }
  if (lane == 0u) store(bent, lows[0], highs[0], scales[0]);
}
