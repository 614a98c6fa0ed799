// What a frame of occlusion queries took, or one decided on the CPU.
#pragma once

#include <cstdint>

namespace jalousie::culling {

/// Counts of one frame.
struct QueryFigures {
  std::uint64_t queries = 0;
  std::uint64_t queryBoxes = 0;       ///< drawn by them
  std::uint64_t queryWaits = 0;       ///< answers that were waited for: not known from a later query to be there
  std::uint64_t queryRoundTrips = 0;  ///< of them: for the newest query, so that nothing is left to do meanwhile
  std::uint64_t querySwitches = 0;    ///< between drawing objects and asking
  std::uint64_t slices = 0;           ///< ranges of objects drawn
  std::uint64_t sliceDraws = 0;       ///< draw calls that drew them: what lies side by side is drawn together
  std::uint64_t shadows = 0;          ///< of occluders that were tested against, in modes that cast shadows
  std::uint64_t rooms = 0;            ///< that are seen, in modes that see rooms; 0 where everything is drawn
  std::uint64_t portals = 0;          ///< tested, once for each time that their room is entered
  std::uint64_t nodesVisited = 0;     ///< of the hierarchy
  std::uint64_t planeTests = 0;       ///< box against plane, of the view or of a shadow
  std::uint64_t decisionNs = 0;       ///< CPU time of the decision itself, without drawing, asking and waiting
};

}  // namespace jalousie::culling
