// Removes triangles that have no area, are duplicates or have positions that are not finite.
#pragma once

#include <cstdint>

#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

struct CleanCounts {
  std::uint64_t notFinite = 0;   ///< a corner is NaN or infinite
  std::uint64_t degenerate = 0;  ///< two corners at one position, or no area
  std::uint64_t duplicate = 0;   ///< same primitive, positions and winding as an earlier triangle
};

/// Drops such triangles from mesh.indices and keeps the order of the rest. Positions that are NaN or infinite become
/// zero; no remaining triangle uses them.
CleanCounts cleanMesh(CombinedMesh& mesh);

}  // namespace jalousie::bake
