// Plain CPU twin of the kernels that build draw lists: bin_objects, scan, scatter and write_commands.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/frame_structs.h"
#include "shared/limits.h"
#include "shared/scene_structs.h"
#include "visibility/object_decision.h"
#include "visibility/submission.h"

namespace jalousie::scene {
struct DrawTables;
}

namespace jalousie::visibility {

/// What a list may hold and how it is drawn.
struct DrawListOptions {
  Submission submission = Submission::kInstanced;
  std::uint32_t capacity = 0;    ///< most instances; the first ones stay
  bool patches = false;          ///< the scene has patch bases: twice as many lists
  std::uint32_t faceRanges = 0;  ///< ranges that FacePass may make of an instance; 0: it does not change the list
};

/// Which of an object's instances are on a list.
inline constexpr std::uint8_t kPlacedOwn = 1;
inline constexpr std::uint8_t kPlacedFadingOut = 2;

/// What one list draws.
struct DrawLists {
  std::vector<gpu::uint> instances;  ///< object ids with kInstance... bits, bin after bin
  std::array<std::vector<gpu::DrawCommand>, gpu::kListCount> commands;  ///< without the empty ones of kInstanced
  /// kPlaced... bits of each object; instances beyond the capacity have no place.
  std::vector<std::uint8_t> placed;
};

/// @param scene    SceneData::drawn()
/// @param objects  of the objects, or of the cells
/// @param phase    kMarkEarly or kMarkLate
DrawLists buildDrawLists(const scene::DrawTables& scene, const gpu::CullView& view, const ObjectDecisions& objects,
                         gpu::uint phase, const DrawListOptions& options);

/// What a frame drawn in slices draws: commands at fixed places. Twin of slice_commands.comp.
struct SliceLists {
  std::vector<gpu::uint> instances;        ///< [2 * places]; 0 where the command is empty
  std::vector<gpu::DrawCommand> commands;  ///< [lists][2 * places], the second half for the levels that fade out
};

/// @param order  [places] object, or cell, of each place   @param listCount  with patches kListCount, else
/// kListsPerDetail   @param objects  of the objects, or of the cells; drawn where marked kMarkLate
SliceLists buildSlices(const scene::DrawTables& scene, const gpu::CullView& view, const ObjectDecisions& objects,
                       std::span<const gpu::uint> order, gpu::uint listCount);

}  // namespace jalousie::visibility
