// Transforms of the moving nodes, and weights of the morph targets, at a time.
//
// One thread: one node, or one weight behind them. Reads nodes, tracks, numbers, weightTable. Writes locals, weights.
// Barrier owed: SHADER_STORAGE for move_targets.comp. CPU twin: src/scene/motion_state.cpp
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/motion_structs.h"
#include "lib/groups.glsl"
#include "lib/transform.glsl"
#include "lib/affine.glsl"

layout(local_size_x = kObjectGroupSize) in;
layout(std140, binding = kBindingMotionView) uniform MotionViewBlock { MotionView motionView; };
layout(std430, binding = kBindingMotionNodes) readonly buffer MotionNodeBlock { MotionNode nodes[]; };
layout(std430, binding = kBindingMotionTracks) readonly buffer MotionTrackBlock { MotionTrack tracks[]; };
layout(std430, binding = kBindingMotionNumbers) readonly buffer MotionNumberBlock { float numbers[]; };
layout(std430, binding = kBindingMotionLocals) writeonly buffer MotionLocalBlock { Transform locals[]; };
layout(std430, binding = kBindingMotionWeights) readonly buffer MotionWeightBlock { MotionWeight weightTable[]; };
layout(std430, binding = kBindingWeights) writeonly buffer WeightBlock { float weights[]; };

#include "lib/motion_keys.glsl"

/// translation * rotation * scale.
Transform transformOf(vec3 translation, vec4 q, vec3 scale) {
  vec3 twice = 2.0 * q.xyz;
  vec3 turned = q.w * twice;
  vec3 x = vec3(1.0 - q.y * twice.y - q.z * twice.z, q.x * twice.y - turned.z, q.x * twice.z + turned.y);
  vec3 y = vec3(q.x * twice.y + turned.z, 1.0 - q.x * twice.x - q.z * twice.z, q.y * twice.z - turned.x);
  vec3 z = vec3(q.x * twice.z - turned.y, q.y * twice.z + turned.x, 1.0 - q.x * twice.x - q.y * twice.y);
  return Transform(vec4(scale * x, translation.x), vec4(scale * y, translation.y), vec4(scale * z, translation.z));
}

void main() {
  uint thread = threadNumber();
  if (thread < motionView.nodeCount) {
    MotionNode node = nodes[thread];
    Transform own = transformOf(vectorAt(node.translationTrack, node.translation.xyz),
                                rotationAt(node.rotationTrack, node.rotation),
                                vectorAt(node.scaleTrack, node.scale.xyz));
    Transform anchor = Transform(node.anchorFromParent0, node.anchorFromParent1, node.anchorFromParent2);
    locals[thread] = product(anchor, own);
    return;
  }
  uint weight = thread - motionView.nodeCount;
  if (weight >= motionView.weightCount) return;
  MotionWeight entry = weightTable[weight];
  weights[weight] = entry.rest;
  if (entry.track == kNoMotion) return;
  MotionTrack track = tracks[entry.track];
  weights[weight] = componentAt(track, findKeys(track), entry.component);
}
