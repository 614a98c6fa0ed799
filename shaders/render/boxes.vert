// Draws one object's bounding rectangle on the screen as a loop of four lines, coloured by the verdict. Objects without
// a rectangle collapse to a point outside the view. One instance: one object.
#version 450 core
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "shared/frame_structs.h"
#include "shared/palette.h"
#include "lib/draw_buffers.glsl"

flat out vec3 tint;

/// Linear RGB.
vec3 verdictColor(uint verdict) {
  if (verdict == kVerdictOccluded || verdict == kVerdictStale) return kColorBoxOccluded.rgb;
  if (verdict == kVerdictPartial) return kColorBoxPartial.rgb;
  return verdict == kVerdictOccluder ? kColorBoxOccluder.rgb : kColorBoxVisible.rgb;
}

void main() {
  ScreenBox box = boxes[gl_InstanceID];
  uint verdict = states[gl_InstanceID].verdict;
  vec2 low = vec2(box.minX, box.minY) + 0.5;
  vec2 high = max(vec2(box.maxX, box.maxY) - 0.5, low);
  uint corner = uint(gl_VertexID) & 3u;
  vec2 point = vec2(corner == 1u || corner == 2u ? high.x : low.x, corner >= 2u ? high.y : low.y);
  bool absent = box.maxX <= box.minX || verdict == kVerdictOutside || verdict == kVerdictNear;
  vec2 clip = 2.0 * point / vec2(drawView.viewportWidth, drawView.viewportHeight) - 1.0;
  gl_Position = absent ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(clip, 0.5, 1.0);
  tint = verdictColor(verdict);
}
