// Points and ends of line segments, which are in world space already.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/vertex_attributes.glsl"

layout(std140, binding = kBindingDrawView) uniform DrawViewBlock { DrawView drawView; };

out Loose {
  vec3 positionWorld;
  vec3 normalWorld;  // 0: not lit
  TextureCoordinates uv;
  vec4 color;
  flat uint material;
} vertex;

void main() {
  vertex.positionWorld = position;
  vertex.normalWorld = normal.xyz;
  vertex.uv = textureCoordinates();
  vertex.color = color;
  vertex.material = material;
  gl_Position = drawView.clipFromWorld * vec4(position, 1.0);
}
