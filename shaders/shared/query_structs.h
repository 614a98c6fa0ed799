// What the modes with occlusion queries hand to their kernels.
#ifndef JALOUSIE_SHARED_QUERY_STRUCTS_H
#define JALOUSIE_SHARED_QUERY_STRUCTS_H

#include "shared/types.h"

JAL_SHARED_BEGIN

/// Sizes of a frame drawn in slices; std140 uniform block.
struct SliceView {
  uint objectCount;
  uint unitCount;        // what has a command each: cells, or objects where there are none
  uint commandCapacity;  // commands per list: two per unit, the second for the level that fades out
  uint listCount;        // lists in the buffer of commands: with patches kListCount, else kListsPerDetail
  uint threshold;        // a node is visible if more samples pass
  float importance;      // samples count where the importance mask is at least this
  uint faceCommands;     // commands for each place where groups of back faces are culled (slice_faces.comp); else 0
  uint reserved0;
};
JAL_ASSERT_SIZE(SliceView, 32)

/// Objects that are drawn if a node was found visible.
struct SliceRange {
  uint firstUnit;
  uint unitCount;
  uint node;  // whose samples decide
  uint reserved0;
};
JAL_ASSERT_SIZE(SliceRange, 16)

/// Count of a node that has no query of its own: it is visible.
const uint kSamplesUnknown = 0xffffffffu;

const uint kBindingOrder = 0u;
const uint kBindingRanges = 0u;
const uint kBindingDrawnBits = 1u;
const uint kBindingLeafOf = 2u;
const uint kBindingSamples = 3u;
const uint kBindingSliceInstances = 7u;
const uint kBindingSliceView = 6u;  // uniform block
// Of slice_faces.comp, beside those of face_structs.h and the draw lists.
const uint kBindingFaceOrder = 1u;
const uint kBindingFaceMarks = 7u;

JAL_SHARED_END

#endif
