// The box of a node of the hierarchy, for an occlusion query: twelve triangles without a vertex buffer, grown on all
// sides by the width of a pixel at the depth of its farthest corner. CPU twin of the growth: culling::queryGrowth
#version 450 core
#include "shared/limits.h"
#include "shared/frame_structs.h"

layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
layout(location = 0) in vec3 minWorld;
layout(location = 1) in vec3 maxWorld;

/// Corner of the box: two triangles for each face, a face for each side of an axis.
bvec3 cornerOf(uint vertex) {
  uint axis = vertex / 12u;
  bool upper = vertex / 6u % 2u != 0u;
  uint number = vertex % 6u;
  uint corner = number < 3u ? number : number - 2u;  // 0 1 2, then 1 2 3
  bool u = (corner & 1u) != 0u;
  bool v = (corner & 2u) != 0u;
  return axis == 0u ? bvec3(upper, u, v) : axis == 1u ? bvec3(v, upper, u) : bvec3(u, v, upper);
}

void main() {
  vec3 forward = cullView.forwardWorld.xyz;
  vec3 farthest = max(forward * (minWorld - cullView.cameraWorld.xyz), forward * (maxWorld - cullView.cameraWorld.xyz));
  float depth = cullView.forwardWorld.w != 0.0 ? 1.0 : max(farthest.x + farthest.y + farthest.z, 0.0);
  float growth = depth / cullView.focalPixels;
  vec3 corner = mix(minWorld - growth, maxWorld + growth, vec3(cornerOf(uint(gl_VertexID))));
  gl_Position = cullView.clipFromWorld * vec4(corner, 1.0);
}
