// Plain CPU twins of the kernels that correct a frame drawn in slices; the commands are buildSlices().
#pragma once

#include <span>
#include <vector>

#include "shared/frame_structs.h"
#include "shared/query_structs.h"
#include "shared/scene_structs.h"

namespace jalousie::visibility {

/// What was drawn of a frame, by place in the hierarchy's order.
struct DrawnSlices {
  std::span<const gpu::uint> order;      ///< [objects] object of each place
  std::span<const gpu::uint> drawnBits;  ///< [(objects + 31) / 32]
  std::span<const gpu::uint> leafOf;     ///< [objects] node of each place
  std::span<const gpu::uint> samples;    ///< [nodes]; kSamplesUnknown: visible
  gpu::uint threshold = 0;
};

/// States and marks of objects, or of cells.
struct MutableDecisions {
  std::vector<gpu::ObjectState>& states;
  std::vector<gpu::uint>& marks;
};

/// Twin of hide_objects.comp.
void hideObjects(const DrawnSlices& slices, const MutableDecisions& objects);
/// Twin of hide_cells.comp. @param objects  after hideObjects
void hideCells(std::span<const gpu::Object> cells, const MutableDecisions& objects, const MutableDecisions& ofCells);

}  // namespace jalousie::visibility
