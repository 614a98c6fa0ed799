// Fills the fragment inputs from an object-space vertex; used by the plain vertex stage and by the patch stage.

out Fragment {
  vec3 positionWorld;
  vec3 normalWorld;
  vec2 uv;
  vec4 color;
  flat vec3 tint;       // colour of a debug view, if one is on
  flat uint material;
  flat uint mirrored;
} fragment;

/// Colour that a debug view gives to one object.
vec3 viewTint(uint objectId) {
  ObjectState state = states[objectId];
  if (drawView.view == kViewLv) return heatColor(clamp(0.5 * state.lv + 0.5, 0.0, 1.0));
  uint lodCount = chains[objects[objectId].chain].lodCount;
  float coarseness = drawView.detail == kDetailTessellation
                         ? float(drawView.maxTessellation - state.tessellation) / float(max(drawView.maxTessellation, 2u) - 1u)
                         : float(state.lod) / float(max(lodCount, 2u) - 1u);
  return lodColor(state.verdict == kVerdictOccluder, coarseness);
}

void emitVertex(uint objectId, vec3 position, vec3 normal, vec2 uv, vec4 color, uint material) {
  Object object = objects[objectId];
  fragment.positionWorld =
      transformPoint(object.worldFromObject0, object.worldFromObject1, object.worldFromObject2, position);
#ifndef JAL_OPACITY
  fragment.normalWorld =
      transformNormal(object.worldFromObject0, object.worldFromObject1, object.worldFromObject2, normal);
  fragment.tint = drawView.view == kViewLod || drawView.view == kViewLv ? viewTint(objectId) : vec3(0.0);
#endif
#if !defined(JAL_OPACITY) || defined(JAL_SHEET)
  fragment.uv = uv;
  fragment.color = color;
  fragment.material = material;
  fragment.mirrored = object.flags & kObjectMirrored;
#endif
  gl_Position = drawView.clipFromWorld * vec4(fragment.positionWorld, 1.0);
}
