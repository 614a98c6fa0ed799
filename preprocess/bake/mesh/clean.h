// Removal of triangles that have no area, stand twice or lie nowhere.
#pragma once

#include <cstdint>

#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

struct CleanCounts {
  std::uint64_t notFinite = 0;   ///< a corner is NaN or infinite
  std::uint64_t degenerate = 0;  ///< two corners at one position, or no area
  std::uint64_t duplicate = 0;   ///< same primitive, positions and winding as an earlier triangle
};

/// Drops such triangles from mesh.indices, keeping the order of the rest. Positions that are no number become zero;
/// then no triangle uses them.
CleanCounts cleanMesh(CombinedMesh& mesh);

}  // namespace jalousie::bake
