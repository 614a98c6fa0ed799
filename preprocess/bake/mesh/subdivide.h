// Loop subdivision of a whole mesh.
#pragma once

#include <cstdint>

#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

/// Replaces the mesh by its Loop subdivision, `steps` times four triangles for one (Loop 1987), on position-welded
/// topology, with smooth normals. @pre cleaned Errors: kUnsupported (several primitives, attributes beside POSITION and
/// NORMAL, non-manifold faces with their count), kLimit (more than 2^26 triangles).
void subdivideMesh(CombinedMesh& mesh, std::uint32_t steps);

}  // namespace jalousie::bake
