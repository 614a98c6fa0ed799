// What a frame decides about an object, as the CPU twins pass it on.
#pragma once

#include <span>

#include "shared/frame_structs.h"
#include "shared/limits.h"

namespace jalousie::visibility {

/// Whether the frame draws an object of this verdict.
inline bool isDrawn(const gpu::ObjectState& state) {
  return state.verdict != gpu::kVerdictOutside && state.verdict != gpu::kVerdictSmall &&
         state.verdict != gpu::kVerdictOccluded;
}

/// One object.
struct ObjectDecision {
  gpu::ObjectState state{};
  gpu::ScreenBox box{};
  gpu::uint marks = 0;  ///< kMark...
};

/// All objects: three arrays of [scene.objects.size()].
struct ObjectDecisions {
  std::span<const gpu::ObjectState> states;
  std::span<const gpu::ScreenBox> boxes;
  std::span<const gpu::uint> marks;

  ObjectDecision operator[](std::size_t object) const { return {states[object], boxes[object], marks[object]}; }
};

}  // namespace jalousie::visibility
