// Sets one level for all edges of an object's patches: equal on both sides of every edge, so no T-junctions.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/draw_buffers.glsl"
#include "lib/texture_coordinates.glsl"

layout(vertices = 3) out;

in Corner {
  vec3 position;
  vec3 normal;
  TextureCoordinates uv;
  vec4 color;
  flat uint material;
  flat uint objectId;
} corner[];

out Control {
  vec3 position;
  vec3 normal;
  TextureCoordinates uv;
  vec4 color;
  flat uint material;
  flat uint objectId;
} control[];

void main() {
  control[gl_InvocationID].position = corner[gl_InvocationID].position;
  control[gl_InvocationID].normal = corner[gl_InvocationID].normal;
  control[gl_InvocationID].uv = corner[gl_InvocationID].uv;
  control[gl_InvocationID].color = corner[gl_InvocationID].color;
  control[gl_InvocationID].material = corner[gl_InvocationID].material;
  control[gl_InvocationID].objectId = corner[gl_InvocationID].objectId;
  if (gl_InvocationID == 0) {
    float level = float(states[corner[0].objectId].tessellation);
    gl_TessLevelInner[0] = level;
    gl_TessLevelOuter[0] = level;
    gl_TessLevelOuter[1] = level;
    gl_TessLevelOuter[2] = level;
  }
}
