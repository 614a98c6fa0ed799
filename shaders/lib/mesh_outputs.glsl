// Fills the fragment inputs from an object-space vertex; used by the plain vertex stage and by the patch stage.

#include "lib/texture_coordinates.glsl"
#include "lib/view_ray.glsl"

out Fragment {
#include "lib/fragment_members.glsl"
} fragment;

/// Heat colour of the covered share of the block in front of an object, or of its mean open chord (logarithmic).
vec3 coverTint(uint view, uint cover) {
  vec2 shareAndChord = unpackHalf2x16(cover);
  if (view == kViewCoverage) return heatColor(shareAndChord.x);
  return heatColor(clamp(log2(max(shareAndChord.y, 1.0)) / log2(kHoleScalePixels), 0.0, 1.0));
}

/// Colour that a debug view gives to one object. @param chain  of the object or of one of its cells: equally long
vec3 viewTint(uint objectId, Chain chain) {
  ObjectState state = states[objectId];
  if (drawView.view == kViewGhost) return ghostColor(state.verdict);
  if (drawView.view == kViewCoverage || drawView.view == kViewHoles)
    return coverTint(drawView.view, boxes[objectId].cover);
  if (drawView.view == kViewLv) return heatColor(clamp(0.5 * state.lv + 0.5, 0.0, 1.0));
  if (drawView.view == kViewPhase) return phaseColor(state.verdict, marks[objectId]);
  uint coarser = drawView.patches != 0u ? drawView.maxTessellation - state.tessellation : state.lod;
  if (drawView.view == kViewLevels) return levelColor(coarser);
  uint levels = drawView.patches != 0u ? drawView.maxTessellation : chain.lodCount;
  float coarseness = float(coarser) / float(max(levels, 2u) - 1u);
  vec3 color = lodColor(state.verdict == kVerdictOccluder, coarseness);
  return drawView.view == kViewLines ? lineColor(color) : color;
}

/// Share of the pixels that a level in a cross-fade has: positive if it fades in, negative if it fades out; 0: no fade.
float fadeShare(uint entry, uint objectId) {
  if ((entry & (kInstanceFadingIn | kInstanceFadingOut)) == 0u) return 0.0;
  uint frames = (marks[objectId] & kMarkFadeMask) >> kMarkFadeShift;
  float fadingIn = float(drawView.fadeFrames + 1u - frames) / float(drawView.fadeFrames + 1u);
  return (entry & kInstanceFadingIn) != 0u ? fadingIn : fadingIn - 1.0;
}

/// A vertex in object space.
struct MeshVertex {
  vec3 position;
  vec3 normal;
  TextureCoordinates uv;
  vec4 color;
  uint material;
};

/// @param entry  of the instance list: an object, or a cell where the scene has cells
void emitVertex(uint entry, MeshVertex vertex) {
  Object part = objects[entry & kInstanceObject];
  uint objectId = part.object;
  Transform transform = transforms[part.transform];
  fragment.positionWorld = transformPoint(transform, vertex.position);
#ifdef JAL_OPACITY
  // A coarser level may lie in front of LOD 0. Move it away from the eye along the view ray: it covers the same pixels.
  fragment.positionWorld +=
      drawView.depthGuard * viewRay(drawView.cameraWorld, drawView.forwardWorld, fragment.positionWorld);
#endif
#ifdef JAL_SHADED
  fragment.normalWorld = transformNormal(transform, vertex.normal);
  fragment.tint = isShadedView(drawView.view) ? vec3(0.0) : viewTint(objectId, chains[part.chain]);
#endif
#if defined(JAL_SHADED) || defined(JAL_SHEET)
  fragment.uv = vertex.uv;
  fragment.color = vertex.color;
  fragment.material = vertex.material;
  fragment.mirrored = isMirrored(transform) ? 1u : 0u;
#endif
#ifdef JAL_SHEET
  fragment.fade = fadeShare(entry, objectId);
#endif
#if defined(JAL_ID) || defined(JAL_SHADED)
  fragment.objectId = objectId;
#endif
  gl_Position = drawView.clipFromWorld * vec4(fragment.positionWorld, 1.0);
}
