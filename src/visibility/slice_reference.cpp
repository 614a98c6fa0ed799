// One object or cell after the other.
#include "visibility/slice_reference.h"

namespace jalousie::visibility {

void hideObjects(const DrawnSlices& slices, const MutableDecisions& objects) {
  for (std::size_t place = 0; place < slices.order.size(); ++place) {
    const gpu::uint id = slices.order[place];
    const bool asked = (slices.drawnBits[place / 32] >> place % 32 & 1U) != 0;
    if (asked && slices.samples[slices.leafOf[place]] > slices.threshold) continue;
    if ((objects.marks[id] & gpu::kMarkLate) == 0) continue;
    objects.marks[id] &= ~(gpu::kMarkLate | gpu::kMarkVisible);
    objects.states[id].verdict = gpu::kVerdictOccluded;
  }
}

void hideCells(std::span<const gpu::Object> cells, const MutableDecisions& objects, const MutableDecisions& ofCells) {
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const gpu::uint object = cells[cell].object;
    if ((objects.marks[object] & gpu::kMarkLate) != 0) continue;
    ofCells.states[cell].verdict = objects.states[object].verdict;
    ofCells.marks[cell] &= ~(gpu::kMarkLate | gpu::kMarkVisible);
  }
}

}  // namespace jalousie::visibility
