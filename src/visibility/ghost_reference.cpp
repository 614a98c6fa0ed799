// The rule of the ghost view for one object.
#include "visibility/ghost_reference.h"

namespace jalousie::visibility {

Ghost ghostOf(const gpu::Chain& chain, const gpu::ObjectState& state, gpu::uint marks, bool twoPhases) {
  const gpu::uint phases = gpu::kMarkLate | (twoPhases ? gpu::kMarkEarly : 0);
  const bool drawn = (marks & phases) != 0;
  return {{state.verdict, chain.lodCount - 1, 1, 1.0F}, drawn ? 0 : gpu::kMarkLate | (marks & gpu::kMarkMirrored)};
}

}  // namespace jalousie::visibility
