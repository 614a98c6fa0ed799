// Removes triangles that have no area, are duplicates or have positions that are not finite.
#pragma once

#include <cstdint>

#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

struct CleanCounts {
  std::uint64_t notFinite = 0;   ///< a corner is NaN or infinite
  std::uint64_t degenerate = 0;  ///< two corners at one position, or no area and no bridge
  std::uint64_t bridges = 0;     ///< no area, but kept: they join triangles along a line
  std::uint64_t snapped = 0;     ///< vertices that --weld moved onto others
  std::uint64_t duplicate = 0;   ///< same primitive, positions and winding as an earlier triangle
};

/// Drops such triangles, bridges excepted, from mesh.indices and keeps the order of the rest. Positions that are NaN or
/// infinite become zero; no remaining triangle uses them.
CleanCounts cleanMesh(CombinedMesh& mesh);

/// Lets triangles use the first of several vertices that have equal positions and attributes in one primitive, as
/// welding leaves them.
void shareEqualVertices(CombinedMesh& mesh);

}  // namespace jalousie::bake
