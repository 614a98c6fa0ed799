// Patch path: hands the base mesh's corners to the tessellator in object space.
#version 450 core
#ifdef JAL_DRAW_PARAMETERS
#extension GL_ARB_shader_draw_parameters : require
#endif
#include "shared/limits.h"
#include "shared/frame_structs.h"

#include "lib/vertex_attributes.glsl"
#include "lib/object_id.glsl"

out Corner {
  vec3 position;
  vec3 normal;
  TextureCoordinates uv;
  vec4 color;
  flat uint material;
  flat uint objectId;
} corner;

void main() {
  corner.position = position;
  corner.normal = normal.xyz;
  corner.uv = textureCoordinates();
  corner.color = color;
  corner.material = material;
  corner.objectId = instanceEntry() & kInstanceObject;
  gl_Position = vec4(position, 1.0);
}
