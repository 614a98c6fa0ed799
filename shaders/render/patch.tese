// Evaluates the Phong-tessellated surface in object space.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/palette.h"
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
  TextureCoordinates uv;
  vec4 color;
  flat uint material;
  flat uint objectId;
} control[];

void main() {
  vec3 b = gl_TessCoord;
  MeshVertex vertex;
  vertex.position = phongPoint(b, vec3[3](control[0].position, control[1].position, control[2].position),
                               vec3[3](control[0].normal, control[1].normal, control[2].normal), drawView.phongAlpha);
  vertex.normal = b.x * control[0].normal + b.y * control[1].normal + b.z * control[2].normal;
  vertex.uv = b.x * control[0].uv + b.y * control[1].uv + b.z * control[2].uv;
  vertex.color = b.x * control[0].color + b.y * control[1].color + b.z * control[2].color;
  vertex.material = control[0].material;
  emitVertex(control[0].objectId, vertex);
}
