// Plain path: one vertex of one object, straight to the fragments.
// JAL_OPACITY: for the occlusion map. JAL_SHEET: double-sided and masked surfaces.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/transform.glsl"
#include "lib/palette.glsl"
#include "lib/draw_buffers.glsl"
#include "lib/mesh_outputs.glsl"

layout(location = kAttributePosition) in vec3 position;
layout(location = kAttributeNormal) in vec4 normal;
layout(location = kAttributeUv) in vec2 uv;
layout(location = kAttributeColor) in vec4 color;
layout(location = kAttributeMaterial) in uint material;
layout(location = kAttributeObject) in uint objectId;  // per instance, from baseInstance

void main() { emitVertex(objectId, position, normal.xyz, uv, color, material); }
