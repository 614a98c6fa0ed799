// Figures of one frame, as the GPU counts them. Plain CPU twin of shaders/visibility/count_states.comp.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "policy/traits.h"
#include "scene/scene_data.h"
#include "shared/frame_structs.h"
#include "shared/limits.h"

namespace jalousie::visibility {

using FrameCounters = std::array<gpu::uint, gpu::kCounterCount>;

/// Whether an object is drawn into the frame, by its marks.
inline bool isDrawn(gpu::uint marks, gpu::uint traits) {
  return (marks & (has(traits, gpu::kTraitTwoPhases) ? gpu::kMarkEarly | gpu::kMarkLate : gpu::kMarkLate)) != 0;
}

/// Triangles one object is drawn with.
std::uint64_t trianglesOf(const scene::SceneData& scene, const gpu::Chain& chain, gpu::uint traits,
                          const gpu::ObjectState& state);

/// @param states, marks  [scene.objects.size()]
FrameCounters countStates(const scene::SceneData& scene, const gpu::CullView& view,
                          std::span<const gpu::ObjectState> states, std::span<const gpu::uint> marks);

/// The triangles that the four limbs add up to.
std::uint64_t triangleSum(const FrameCounters& counters);

}  // namespace jalousie::visibility
