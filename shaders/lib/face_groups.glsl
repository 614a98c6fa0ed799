// The groups of a level that are not all back faces. Needs faceView and nodes; the kernel defines addRange().
// CPU twin: src/visibility/face_reference.cpp

/// Draws indices of the level. Calls come in the order of the indices. @param count  0: nothing
void addRange(uint first, uint count);

/// Of the instance, for masks.
const vec3 kNoRay = vec3(0.0);
vec3 rays[8] = vec3[8](kNoRay, kNoRay, kNoRay, kNoRay, kNoRay, kNoRay, kNoRay, kNoRay);

/// Whether all triangles of a node are back faces.
bool isBack(FaceNode node, FaceFrame frame, Transform t) {
  float slack = faceView.test == kFacesMask   ? sectorLeast(node, rays)
                : faceView.test == kFacesCone ? coneSlack(node, frame.eye)
                                              : clusterSlack(node, frame.eye);
  if (!(slack > 0.0)) return false;
  FaceMargin margin = faceMargin(frame, t, node.sphere, node.inradius);
  if (faceView.test == kFacesMask) slack = maskSlack(slack, frame, margin);
  return slack > margin.least;
}

/// Nodes lie in depth-first order, so that the tree is traversed without a stack.
void addGroups(FaceLod lod, Transform t) {
  FaceFrame frame = faceFrame(t, lod);
  bool tree = faceView.test == kFacesTree;
  if (faceView.test == kFacesMask)
    for (uint corner = 0u; corner < 8u; ++corner) rays[corner] = sectorRay(lod, frame, corner);
  for (uint n = lod.firstNode; n < lod.firstNode + lod.nodeCount;) {
    FaceNode node = nodes[n];
    bool group = node.next == n + 1u;
    if ((group || tree) && isBack(node, frame, t)) {
      n = node.next;
    } else if (group || (tree && isFrontCluster(node, frame.eye))) {
      addRange(node.firstIndex, node.indexCount);
      n = node.next;
    } else {
      ++n;
    }
  }
}
