// Where a point is seen from. Include first: shared/frame_structs.h.

/// From the eye to a point; the direction of the view for an orthographic camera. Not a unit vector for a perspective
/// camera. @param eyeWorld, forwardWorld  as in DrawView
vec3 viewRay(vec4 eyeWorld, vec4 forwardWorld, vec3 pointWorld) {
  return forwardWorld.w == 0.0 ? pointWorld - eyeWorld.xyz : forwardWorld.xyz;
}
