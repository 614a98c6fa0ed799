// Keeps the attributes of levels within those of the mesh that they were made from.
#pragma once

#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

/// Simplification extends attributes linearly, beyond white for example. Colours and custom attributes of a level get
/// no values below the least or above the greatest of the same primitive in the finest mesh.
/// @pre the level has the primitives and attributes of the finest mesh
void clampToRange(CombinedMesh& level, const CombinedMesh& finest);

}  // namespace jalousie::bake
