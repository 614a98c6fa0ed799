// Fewer triangles on the same vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/combined_mesh.h"

namespace jalousie::bake {

/// Collapses edges until at most targetTriangles are left or nothing more can go; corners are vertices of `mesh`.
/// Attribute seams are kept first; where they leave too little freedom (flat-shaded meshes) positions are welded and
/// each corner takes the vertex whose normal fits its face best.
/// @param indices  the level to start from   @return  three per triangle, maybe more or fewer triangles than asked
std::vector<std::uint32_t> simplifyTriangles(const CombinedMesh& mesh, const std::vector<std::uint32_t>& indices,
                                             std::uint32_t targetTriangles);

}  // namespace jalousie::bake
