// Gives the fragments of a triangle its area on the screen, for the density view.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "lib/draw_buffers.glsl"
#include "lib/texture_coordinates.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in Fragment {
#include "lib/fragment_members.glsl"
} corners[];

// The members of lib/fragment_members.glsl again: a file is included once. The program does not link if they differ.
out Fragment {
  vec3 positionWorld;
  vec3 normalWorld;
  TextureCoordinates uv;
  vec4 color;
  flat vec3 tint;
  flat uint material;
  flat uint mirrored;
  flat uint objectId;
  flat float fade;
} fragment;
flat out float areaPixels;  // of the whole triangle, also where it leaves the screen

/// Pixels, origin in the middle of the screen. @pre clip.w > 0
vec2 screenPoint(vec4 clip) { return 0.5 * vec2(drawView.viewportWidth, drawView.viewportHeight) * clip.xy / clip.w; }

float areaOnScreen(vec4 a, vec4 b, vec4 c) {
  if (min(a.w, min(b.w, c.w)) <= 0.0) return kLargestTriangleArea;  // it reaches behind the eye
  vec2 from = screenPoint(a);
  vec2 u = screenPoint(b) - from;
  vec2 v = screenPoint(c) - from;
  return 0.5 * abs(u.x * v.y - u.y * v.x);
}

void main() {
  float area = areaOnScreen(gl_in[0].gl_Position, gl_in[1].gl_Position, gl_in[2].gl_Position);
  for (int i = 0; i < 3; ++i) {
    gl_Position = gl_in[i].gl_Position;
    areaPixels = area;
    fragment.positionWorld = corners[i].positionWorld;
    fragment.uv = corners[i].uv;
    fragment.color = corners[i].color;
    fragment.material = corners[i].material;
    fragment.mirrored = corners[i].mirrored;
    fragment.fade = corners[i].fade;
    EmitVertex();
  }
  EndPrimitive();
}
