// Statistics of one frame, as the GPU counts them. Plain CPU twin of shaders/visibility/count_states.comp.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "policy/traits.h"
#include "shared/frame_structs.h"
#include "shared/limits.h"
#include "shared/scene_structs.h"

namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::visibility {

using FrameCounters = std::array<gpu::uint, gpu::kCounterCount>;

/// Whether an object is drawn into the frame. @param marks  kMark...   @param traits  gpu::CullView::traits
inline bool isDrawn(gpu::uint marks, gpu::uint traits) {
  return (marks & (has(traits, gpu::kTraitTwoPhases) ? gpu::kMarkEarly | gpu::kMarkLate : gpu::kMarkLate)) != 0;
}

/// Bits of each object on the two lists of a frame (DrawLists::placed). Empty: everything found room.
struct PlacedInstances {
  std::span<const std::uint8_t> early;
  std::span<const std::uint8_t> late;
};

/// Triangles that one object is drawn with. @param traits  gpu::CullView::traits
std::uint64_t trianglesOf(const scene::SceneData& scene, const gpu::Chain& chain, gpu::uint traits,
                          const gpu::ObjectState& state);

/// What a frame decided about the cells of a scene.
struct CellDecisions {
  std::span<const gpu::ObjectState> states;  ///< [scene.cells.objects.size()]
  std::span<const gpu::uint> marks;
  PlacedInstances placed;  ///< of the cells
};

/// Scenes with cells: counts the cells of the lists. The figures of objects are those of countStates, to be added.
/// Twin of shaders/visibility/count_cells.comp.
/// @param objectMarks  [scene.objects.size()]; get kMarkPlaced and kMarkPlacedFading, which countStates reads
FrameCounters countCells(const scene::SceneData& scene, const gpu::CullView& view, const CellDecisions& cells,
                         std::span<gpu::uint> objectMarks);

/// @param states, marks  [scene.objects.size()]
/// @param placed  of the objects; without effect in scenes with cells
FrameCounters countStates(const scene::SceneData& scene, const gpu::CullView& view,
                          std::span<const gpu::ObjectState> states, std::span<const gpu::uint> marks,
                          const PlacedInstances& placed = {});

/// Number of drawn triangles: the sum of the four counters kCounterTriangles.
std::uint64_t triangleSum(const FrameCounters& counters);

}  // namespace jalousie::visibility
