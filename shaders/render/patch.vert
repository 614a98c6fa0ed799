// Patch path: hands the base mesh's corners to the tessellator in object space.
#version 450 core
#include "shared/limits.h"

layout(location = kAttributePosition) in vec3 position;
layout(location = kAttributeNormal) in vec4 normal;
layout(location = kAttributeUv) in vec2 uv;
layout(location = kAttributeColor) in vec4 color;
layout(location = kAttributeMaterial) in uint material;
layout(location = kAttributeObject) in uint objectId;

out Corner {
  vec3 position;
  vec3 normal;
  vec2 uv;
  vec4 color;
  flat uint material;
  flat uint objectId;
} corner;

void main() {
  corner.position = position;
  corner.normal = normal.xyz;
  corner.uv = uv;
  corner.color = color;
  corner.material = material;
  corner.objectId = objectId;
  gl_Position = vec4(position, 1.0);
}
