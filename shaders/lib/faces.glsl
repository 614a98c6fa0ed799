// Tests of groups of triangles (docs/back_faces.md). A group is culled if every triangle is a back face by so much that
// the rasteriser, which moves vertices by up to kSnapPixels, cannot make a front face of it. Needs the culling view and
// lib/transform.glsl. CPU twin: src/visibility/face_reference.cpp

/// One instance as the tests see it.
struct FaceFrame {
  vec4 eye;           // object space: the eye (w = 1), or against the direction of view (w = 0)
  vec4 depth;         // distance of a point along the direction of view: dot(depth, (p, 1)), world units
  float scale;        // bound of the lengthening by the transform
  float volume;       // |determinant|
  float roundWorld;   // bounds of rounding errors of a world-space point and of n.(p - eye)
  float roundObject;
};

FaceFrame faceFrame(Transform t, FaceLod lod) {
  vec3 c0 = cross(t.worldFromObject1.xyz, t.worldFromObject2.xyz);
  vec3 c1 = cross(t.worldFromObject2.xyz, t.worldFromObject0.xyz);
  vec3 c2 = cross(t.worldFromObject0.xyz, t.worldFromObject1.xyz);
  float determinant = dot(t.worldFromObject0.xyz, c0);
  vec3 moved = vec3(t.worldFromObject0.w, t.worldFromObject1.w, t.worldFromObject2.w);
  bool parallel = cullView.forwardWorld.w != 0.0;
  vec3 forward = cullView.forwardWorld.xyz;
  vec3 from = parallel ? -forward : cullView.cameraWorld.xyz - moved;
  FaceFrame frame;
  frame.eye = vec4((c0 * from.x + c1 * from.y + c2 * from.z) / determinant, parallel ? 0.0 : 1.0);
  frame.depth.xyz = t.worldFromObject0.xyz * forward.x + t.worldFromObject1.xyz * forward.y +
                    t.worldFromObject2.xyz * forward.z;
  frame.depth.w = dot(moved - cullView.cameraWorld.xyz, forward);
  // The largest eigenvalue of M M^T is at most its largest sum of a row.
  vec3 mixed = abs(vec3(dot(t.worldFromObject0.xyz, t.worldFromObject1.xyz),
                        dot(t.worldFromObject1.xyz, t.worldFromObject2.xyz),
                        dot(t.worldFromObject2.xyz, t.worldFromObject0.xyz)));
  vec3 rows = vec3(dot(t.worldFromObject0.xyz, t.worldFromObject0.xyz) + mixed.x + mixed.z,
                   dot(t.worldFromObject1.xyz, t.worldFromObject1.xyz) + mixed.x + mixed.y,
                   dot(t.worldFromObject2.xyz, t.worldFromObject2.xyz) + mixed.y + mixed.z);
  frame.scale = sqrt(max(max(rows.x, rows.y), rows.z));
  frame.volume = abs(determinant);
  float inverseScale = sqrt(dot(c0, c0) + dot(c1, c1) + dot(c2, c2)) / frame.volume;
  float extent = length(lod.boundsMinObject.xyz) + length(lod.boundsMaxObject.xyz);
  float away = length(cullView.cameraWorld.xyz) + length(moved);
  frame.roundWorld = 2.0 * kRounding * (frame.scale * extent + away);
  frame.roundObject = kRounding * (inverseScale * (parallel ? 1.0 : away) + length(frame.eye.xyz) + extent);
  return frame;
}

/// Where a group lies on the screen, and what n.(p - eye) of its triangles has to exceed.
struct FaceMargin {
  float nearest;   // least and largest w of its points
  float farthest;
  float least;     // kFaceNever, infinite or no number if the group must be drawn: it reaches the near plane, or has
                   // triangles without area
};

FaceMargin faceMargin(FaceFrame frame, Transform t, vec4 sphere, float inradius) {
  bool parallel = cullView.forwardWorld.w != 0.0;
  float depth = dot(frame.depth, vec4(sphere.xyz, 1.0));
  float reach = length(frame.depth.xyz) * sphere.w + frame.roundWorld;
  FaceMargin margin = FaceMargin(parallel ? 1.0 : depth - reach, parallel ? 1.0 : depth + reach, kFaceNever);
  if (!(depth - reach > cullView.cameraWorld.w)) return margin;
  // Away from the middle of the picture things are longer by 1 / cos of the angle to the direction of view.
  float slant = 1.0;
  if (!parallel) {
    float away = distance(transformPoint(t, sphere.xyz), cullView.cameraWorld.xyz);
    float cosine = min(depth / away, 1.0);
    float sine = (frame.scale * sphere.w + frame.roundWorld) / away;
    if (!(sine < 1.0)) return margin;
    slant = cosine * sqrt(1.0 - sine * sine) - sqrt(1.0 - cosine * cosine) * sine;
    if (!(slant > 0.0)) return margin;
    slant = 1.0 / slant;
  }
  // Twice the area on the screen is focal^2 |det| 2 A n.(p - eye) / (w0 w1 w2), its change at most the distance that
  // vertices are moved by times the perimeter, and 2.6 times the square of the distance. A is the inradius times half
  // the perimeter, which is at least 10.39 inradii.
  float moved = kSnapPixels + cullView.focalPixels * slant / margin.nearest * frame.roundWorld;
  float pixels = cullView.focalPixels * inradius;
  float share = moved * margin.farthest / pixels;
  margin.least = share * margin.farthest / frame.volume * (frame.scale * slant + 0.25 * share) + frame.roundObject;
  return margin;
}

/// max n.x over a box of normals.
float faceSupport(FaceNode node, vec3 x) {
  vec3 a = mix(node.lowest.xyz, node.highest.xyz, greaterThan(x, vec3(0.0))) * x;
  return a.x + a.y + a.z;
}

/// d - g(eye - c): the least n.(p - eye).
float clusterSlack(FaceNode node, vec4 eye) {
  return node.lowest.w * eye.w - faceSupport(node, eye.xyz - eye.w * node.origin.xyz);
}

/// -g(c - eye) > D: no triangle is a back face.
bool isFrontCluster(FaceNode node, vec4 eye) {
  return -faceSupport(node, eye.w * node.origin.xyz - eye.xyz) > node.highest.w * eye.w;
}

/// n.(apex - eye) at the worst normal of the cone.
float coneSlack(FaceNode node, vec4 eye) {
  if (!(node.axis.w > 0.0)) return -1.0;
  vec3 v = node.apex.xyz * eye.w - eye.xyz;
  float sine = sqrt(max(1.0 - node.axis.w * node.axis.w, 0.0));
  return node.axis.w * dot(v, node.axis.xyz) - sine * length(cross(v, node.axis.xyz)) -
         2.0 * kRounding * (length(v) + length(node.apex.xyz));
}

/// A ray from the eye to a corner of the box, up to the depth 1: the box is the object's own sector of the view.
vec3 sectorRay(FaceLod lod, FaceFrame frame, uint corner) {
  bvec3 high = bvec3((corner & 1u) != 0u, (corner & 2u) != 0u, (corner & 4u) != 0u);
  vec3 p = mix(lod.boundsMinObject.xyz, lod.boundsMaxObject.xyz, high);
  if (frame.eye.w == 0.0) return -frame.eye.xyz;
  float depth = dot(frame.depth, vec4(p, 1.0));
  return depth > cullView.cameraWorld.w ? (p - frame.eye.xyz) / depth : vec3(0.0);
}

/// Least g.ray of the corners of the cells of a group and of the sector. Positive: all triangles are back faces.
float sectorLeast(FaceNode node, vec3 rays[8]) {
  if (node.normals == kNoNormals) return -1.0;
  uint axis = (node.normals & 7u) >> 1u;
  float side = (node.normals & 1u) != 0u ? -1.0 : 1.0;
  float least = kFaceNever;
  for (uint corner = 0u; corner < 4u; ++corner) {
    uint column = (node.normals >> ((corner & 1u) != 0u ? 8u : 3u)) & 31u;
    uint row = (node.normals >> ((corner & 2u) != 0u ? 18u : 13u)) & 31u;
    vec3 g = vec3(side, 2.0 * vec2(column, row) / float(kNormalCells) - 1.0);
    g = axis == 0u ? g.xyz : axis == 1u ? g.zxy : g.yzx;
    for (uint k = 0u; k < 8u; ++k) least = min(least, dot(g, rays[k]));
  }
  return least;
}

/// The least n.(p - eye) that follows for the farthest triangle; the margin grows as fast or faster towards it.
float maskSlack(float least, FaceFrame frame, FaceMargin margin) {
  return margin.farthest * (least / kCubeDiagonal - frame.roundObject / margin.nearest);
}
