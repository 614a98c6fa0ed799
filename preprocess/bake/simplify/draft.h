// The fast collapse for drafts: meshoptimizer, which keeps vertices at their positions.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

/// Collapses half-edges until at most `target` triangles are left or no collapse is possible. A first attempt keeps
/// attribute seams. If seams prevent the target (flat-shaded meshes), each corner takes the wedge of its new vertex, in
/// the same primitive, whose normal fits the triangle best.
/// @param lockBorder  vertices of open borders stay
/// @param corners  the level to start from, wedges of `mesh` in threes   @return  likewise
std::vector<std::uint32_t> draftCorners(const WedgeMesh& mesh, const std::vector<std::uint32_t>& corners,
                                        std::uint32_t target, bool lockBorder);

/// The level with these corners, and for each vertex of `mesh` the level's, ~0 if it went.
struct DraftLevel {
  WedgeMesh mesh;
  std::vector<std::uint32_t> vertexMap;
};
DraftLevel draftLevel(const WedgeMesh& mesh, const std::vector<std::uint32_t>& corners);

}  // namespace jalousie::bake
