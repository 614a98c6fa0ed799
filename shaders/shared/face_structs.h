// Groups of triangles that are culled where all of them face away (docs/back_faces.md).
#ifndef JALOUSIE_SHARED_FACE_STRUCTS_H
#define JALOUSIE_SHARED_FACE_STRUCTS_H

#include "shared/types.h"

JAL_SHARED_BEGIN

/// How groups are tested.
const uint kFacesOff = 0u;      // nothing is tested: levels are drawn whole
const uint kFacesMask = 1u;     // by the cells of the normals (Zhang and Hoff 1997)
const uint kFacesCluster = 2u;  // by the culling volume of each cluster (Kumar et al. 1996)
const uint kFacesTree = 3u;     // the same, from the roots of the trees of clusters down
const uint kFacesCone = 4u;     // by the cone of normals and its apex

/// Largest distance by which a rasteriser moves a vertex, pixels: it has at least eight bits below the pixel (Direct3D
/// 11 asks for them), and some more for the rounding of the viewport transform.
const float kSnapPixels = 0.00390625;  // 2^-8
/// No distance is larger.
const float kFaceNever = 3.0e38F;
/// Least major component of a unit normal is 1 over this: the root of three, rounded up.
const float kCubeDiagonal = 1.7320509F;

/// Cells along a side of the cube that normals are sorted into.
const uint kNormalCells = 16u;
/// FaceNode.normals of a group whose normals lie on several sides of the cube.
const uint kNoNormals = 0xffffffffu;

/// A group of triangles, or a node above two groups. Object space; normals are unit. The nodes of a level are the trees
/// of its groups in depth-first order.
struct FaceNode {
  vec4 lowest;      // xyz: least components of the normals; w: least n.(p - origin)
  vec4 highest;     // xyz: largest components; w: largest n.(p - origin)
  vec4 origin;      // xyz: the point that the distances refer to
  vec4 sphere;      // xyz: middle, w: radius of a sphere that holds the triangles
  vec4 apex;        // xyz: a point behind the planes of all triangles
  vec4 axis;        // xyz: of the cone of normals; w: least n.axis, 0 where there is no cone
  uint firstIndex;  // of the scene's index buffer
  uint indexCount;
  uint next;       // the node behind this one and all below it; the next one: a group
  uint normals;    // rectangle of cells: side of the cube in bits 0-2, then 5 bits each: first and last lattice line of
                   // the two axes; or kNoNormals
  float inradius;  // least radius of the inscribed circle of a triangle; 0: the group is never culled
  float reserved0;
  float reserved1;
  float reserved2;
};
JAL_ASSERT_SIZE(FaceNode, 128)

/// What a level draws: its single-sided opaque triangles, which have groups, and the others, which are left whole.
struct FaceLod {
  vec4 boundsMinObject;  // xyz: of the triangles with groups
  vec4 boundsMaxObject;
  uint firstNode;
  uint nodeCount;   // 0: nothing is known, all is drawn
  uint firstIndex;  // of the solid triangles; the sheets follow
  uint solidCount;  // indices
  uint sheetCount;
  int baseVertex;
  uint reserved0;
  uint reserved1;
};
JAL_ASSERT_SIZE(FaceLod, 64)

/// One object, or cell where the scene has cells.
struct FaceUnit {
  uint firstLod;  // of its chain, index into the levels above
  uint transform;
};
JAL_ASSERT_SIZE(FaceUnit, 8)

/// How a frame tests groups; std140 uniform block.
struct FaceView {
  uint test;        // kFaces...
  uint mostRanges;  // ranges of indices for each instance; what exceeds them is joined
  uint reserved0;
  uint reserved1;
};
JAL_ASSERT_SIZE(FaceView, 16)

/// Work of one list, in words: the numbers of commands of both lists, [2][capacity] and a zero; then kFaceHead words
/// and the ranges of each instance; then the numbers of commands that write_commands.comp left.
const uint kFaceHead = 8u;
const uint kFaceList = 0u;    // kListSolid or kListSheet: where the ranges go
const uint kFaceRanges = 1u;  // their number
const uint kFaceBaseVertex = 2u;
const uint kFaceSheetFirst = 3u;  // the triangles that are left whole: first index, number of indices
const uint kFaceSheetCount = 4u;
const uint kFaceTested = 5u;  // triangles of groups
const uint kFaceCulled = 6u;  // of these, triangles that are not drawn
const uint kFaceWhole = 7u;   // triangles that are left whole

// Sums over the instances of a list, two words each: of bits 0-9, and of the bits above.
const uint kFaceFigureTested = 0u;
const uint kFaceFigureCulled = 2u;
const uint kFaceFigureWhole = 4u;
const uint kFaceFigures = 6u;

// Storage bindings of face_ranges.comp and face_commands.comp, beside those of the draw lists.
const uint kBindingFaceUnits = 2u;
const uint kBindingFaceLods = 3u;
const uint kBindingFaceNodes = 6u;
const uint kBindingFaceCounts = 5u;  // draw counts, while ranges are made
const uint kBindingFaceWork = 7u;    // kBindingEntries: the prefix sum runs over the counts in front
const uint kBindingFaceFigures = 0u;
// Uniform buffer binding.
const uint kBindingFaceView = 5u;

JAL_SHARED_END

#endif
