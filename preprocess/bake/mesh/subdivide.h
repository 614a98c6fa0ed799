// Loop subdivision of a whole mesh.
#pragma once

#include <cstdint>

#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

/// Replaces the mesh by its Loop subdivision (Loop 1987) on position-welded topology, with smooth normals. Each step
/// replaces one triangle by four.
/// @pre cleaned. Errors: kUnsupported (several primitives, attributes beside POSITION and NORMAL, non-manifold faces
/// with their count), kLimit (more than 2^26 triangles)
void subdivideMesh(CombinedMesh& mesh, std::uint32_t steps);

}  // namespace jalousie::bake
