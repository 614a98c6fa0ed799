// Evaluates the Phong-tessellated surface in object space.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/transform.glsl"
#include "lib/palette.glsl"
#include "lib/phong.glsl"
#include "lib/draw_buffers.glsl"
#include "lib/shading.glsl"
#include "lib/mesh_outputs.glsl"

layout(triangles, equal_spacing, ccw) in;

in Control {
  vec3 position;
  vec3 normal;
  vec2 uv;
  vec4 color;
  flat uint material;
  flat uint objectId;
} control[];

void main() {
  vec3 b = gl_TessCoord;
  vec3 position = phongPoint(b, control[0].position, control[1].position, control[2].position, control[0].normal,
                             control[1].normal, control[2].normal, drawView.phongAlpha);
  vec3 normal = b.x * control[0].normal + b.y * control[1].normal + b.z * control[2].normal;
  vec2 uv = b.x * control[0].uv + b.y * control[1].uv + b.z * control[2].uv;
  vec4 color = b.x * control[0].color + b.y * control[1].color + b.z * control[2].color;
  emitVertex(control[0].objectId, position, normal, uv, color, control[0].material);
}
