// Plain CPU twin of shaders/visibility/mark_ghosts.comp: what the ghost view draws of one object.
#pragma once

#include "shared/frame_structs.h"
#include "shared/scene_structs.h"

namespace jalousie::visibility {

/// What the kernel writes for one object.
struct Ghost {
  gpu::ObjectState state{};
  gpu::uint marks = 0;
};

/// State and marks of an object in the draw list of ghosts, the objects that the frame did not draw. A ghost is drawn
/// at the coarsest level of its chain, in the late phase, and keeps the frame's verdict, which chooses its colour.
///   drawn = marks & (kMarkLate | (twoPhases ? kMarkEarly : 0)) != 0
///   ghost = drawn ? 0 : kMarkLate | (marks & kMarkMirrored)
/// Without two phases the early phase draws into the occlusion map only, so kMarkEarly alone does not put an object
/// into the frame.
/// @param chain      the object's chain; lodCount >= 1
/// @param state      what the frame decided   @param marks  kMark..., of the frame
/// @param twoPhases  the culling mode draws both phases into the frame
Ghost ghostOf(const gpu::Chain& chain, const gpu::ObjectState& state, gpu::uint marks, bool twoPhases);

}  // namespace jalousie::visibility
