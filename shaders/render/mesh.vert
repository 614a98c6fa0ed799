// Plain path: one vertex of one object, straight to the fragments.
// JAL_SHADED, JAL_OPACITY, JAL_ID: what the fragments become. JAL_SHEET: double-sided, masked and blended surfaces.
#version 450 core
#ifdef JAL_DRAW_PARAMETERS
#extension GL_ARB_shader_draw_parameters : require
#endif
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/palette.h"
#include "lib/transform.glsl"
#include "lib/palette.glsl"
#include "lib/draw_buffers.glsl"
#include "lib/shading.glsl"
#include "lib/vertex_attributes.glsl"
#include "lib/mesh_outputs.glsl"

#include "lib/object_id.glsl"

void main() { emitVertex(instanceEntry(), MeshVertex(position, normal.xyz, textureCoordinates(), color, material)); }
