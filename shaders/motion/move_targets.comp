// Matrices of what follows the moving nodes: objects, and the joints of skins.
//
// One thread: one target. Reads targets, nodes, locals. Writes transforms of the objects that move, and joints.
// Barrier owed: SHADER_STORAGE for bend_vertices.comp, bound_poses.comp and all kernels and programs that read
// transforms. CPU twin: src/scene/motion_state.cpp
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
layout(std430, binding = kBindingMotionTargets) readonly buffer MotionTargetBlock { MotionTarget targets[]; };
layout(std430, binding = kBindingMovedTransforms) writeonly buffer MovedTransformBlock { Transform transforms[]; };
layout(std430, binding = kBindingMotionLocals) readonly buffer MotionLocalBlock { Transform locals[]; };
layout(std430, binding = kBindingJoints) writeonly buffer JointBlock { Transform joints[]; };

void main() {
  uint thread = threadNumber();
  if (thread >= motionView.targetCount) return;
  MotionTarget target = targets[thread];
  Transform world = Transform(target.nodeFromTarget0, target.nodeFromTarget1, target.nodeFromTarget2);
  for (uint node = target.node; node != kNoMotion; node = nodes[node].anchor)
    world = product(locals[node], world);
  if (thread < motionView.transformCount)
    transforms[target.destination] = world;
  else
    joints[target.destination] = world;
}
