// Animations as the kernels see them: keys, moving nodes, and the vertices and boxes that follow them.
#ifndef JALOUSIE_SHARED_MOTION_STRUCTS_H
#define JALOUSIE_SHARED_MOTION_STRUCTS_H

#include "shared/types.h"

JAL_SHARED_BEGIN

/// Index of a node, a joint or a track that is not there.
const uint kNoMotion = 0xffffffffu;

// Interpolation of a track (glTF 2.0, appendix C).
const uint kMotionStep = 0u;
const uint kMotionLinear = 1u;  // of rotations: along the shorter arc
const uint kMotionCubic = 2u;   // a key has an in-tangent, a value, an out-tangent

/// Keys of one animated property.
struct MotionTrack {
  uint firstTime;      // index into numbers: times, seconds, ascending
  uint keyCount;       // >= 1
  uint firstValue;     // index into numbers
  uint width;          // numbers per value
  uint interpolation;  // kMotion...
};
JAL_ASSERT_SIZE(MotionTrack, 20)

/// A node that animations move relative to its parent. Nodes above it come first.
struct MotionNode {
  vec4 anchorFromParent0;  // rows: from the node's parent to the nearest moving node above it, or to the world
  vec4 anchorFromParent1;
  vec4 anchorFromParent2;
  vec4 translation;  // xyz; of what no track moves
  vec4 rotation;     // quaternion, x y z w
  vec4 scale;        // xyz
  uint anchor;       // index of the nearest moving node above; kNoMotion: the world
  uint translationTrack;
  uint rotationTrack;
  uint scaleTrack;
};
JAL_ASSERT_SIZE(MotionNode, 112)

/// The weight of a morph target of a node's mesh.
struct MotionWeight {
  uint track;      // kNoMotion: it rests
  uint component;  // of the track's values
  float rest;
};
JAL_ASSERT_SIZE(MotionWeight, 12)

/// A matrix that follows a moving node.
struct MotionTarget {
  vec4 nodeFromTarget0;  // rows; worldFromTarget if there is no node
  vec4 nodeFromTarget1;
  vec4 nodeFromTarget2;
  uint node;         // index; kNoMotion: it rests
  uint destination;  // index into transforms, or into joints
  uint reserved0;
  uint reserved1;
};
JAL_ASSERT_SIZE(MotionTarget, 64)

/// Share of a joint in the place of a vertex.
struct Influence {
  uint joint;    // index into joints
  float weight;  // > 0
};
JAL_ASSERT_SIZE(Influence, 8)

/// What a morph target with weight 1 adds to a vertex.
struct MorphDelta {
  vec4 position;  // xyz
  vec4 normal;    // xyz
};
JAL_ASSERT_SIZE(MorphDelta, 32)

// Bits of BentVertex.flags.
const uint kBentLoose = 1u;        // the vertex belongs to points or lines
const uint kBentSkinned = 2u;      // its influences place it, even where it has none
const uint kBentFlat = 4u;         // its normal is that of its triangle, whose three vertices follow each other
const uint kBentCornerShift = 8u;  // which of the three it is, 2 bits

/// A vertex that a skin or morph targets move.
struct BentVertex {
  vec4 position;     // xyz, before targets and skin
  vec4 normal;       // xyz; 0 if the vertex is not lit
  uint destination;  // index into the vertices of the scene, or into those of points and lines
  uint flags;        // kBent...
  uint firstInfluence;
  uint influenceCount;
  uint firstDelta;  // of the first morph target; those of the next ones follow deltaStride apart
  uint deltaStride;
  uint targetCount;  // morph targets
  uint firstWeight;
};
JAL_ASSERT_SIZE(BentVertex, 64)

/// A box of unbent vertices that one joint influences.
struct BentBox {
  vec4 minObject;  // xyz
  vec4 maxObject;
  uint joint;       // kNoMotion: no skin
  uint firstDelta;  // into the boxes of the deltas of each morph target
  uint targetCount;
  uint firstWeight;
};
JAL_ASSERT_SIZE(BentBox, 48)

/// A chain with bent vertices: its box follows the pose.
struct BentChain {
  uint chain;     // index into the objects' chains
  uint firstBox;  // of all its levels
  uint boxCount;
  uint cellChain;  // index into the cells' chains; kNoMotion: there are no cells
  uint firstCellLod;
  uint cellLodCount;
  float leastSum;  // of the weights of a vertex's influences
  float mostSum;
  float bulge;        // share of an edge's length by which a curved surface leaves its triangle at most; 0: all is flat
  float longestEdge;  // of the curved triangles, unbent
  float weightStep;   // how much the weights of the two ends of an edge differ at most, 0 to 1; 1 with morph targets
  uint reserved0;
};
JAL_ASSERT_SIZE(BentChain, 48)

struct MotionView {
  float seconds;
  uint nodeCount;
  uint weightCount;
  uint transformCount;  // targets that write transforms; they come first
  uint targetCount;
  uint vertexCount;
  uint chainCount;
  uint reserved0;
};
JAL_ASSERT_SIZE(MotionView, 32)

/// Bound of the rounding error of a bent vertex, as a share of the sum of the magnitudes that went into it.
const float kBentRounding = 1.0 / 262144.0;

/// Words of scene::Vertex: position, normal, texture coordinates, colour, material.
const uint kVertexWords = 8u;
const uint kVertexNormalWord = 3u;

// Shader storage bindings. move_nodes.comp
const uint kBindingMotionNodes = 0u;
const uint kBindingMotionTracks = 1u;
const uint kBindingMotionNumbers = 2u;
const uint kBindingMotionLocals = 3u;
const uint kBindingMotionWeights = 4u;
const uint kBindingWeights = 5u;
// move_targets.comp
const uint kBindingMotionTargets = 1u;
const uint kBindingMovedTransforms = 2u;
const uint kBindingJoints = 6u;
// bend_vertices.comp
const uint kBindingVertices = 0u;
const uint kBindingLooseVertices = 1u;
const uint kBindingBentVertices = 2u;
const uint kBindingInfluences = 3u;
const uint kBindingDeltas = 4u;
// bound_poses.comp
const uint kBindingMovedChains = 0u;
const uint kBindingMovedCellChains = 1u;
const uint kBindingBentBoxes = 2u;
const uint kBindingBentChains = 3u;
const uint kBindingDeltaBoxes = 4u;
const uint kBindingMovedCellBounds = 7u;
// Uniform buffer.
const uint kBindingMotionView = 5u;

JAL_SHARED_END

#endif
