// Normals rebuilt from the surface, with hard edges where it bends.
#pragma once

#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

/// Gives every primitive new NORMALs: edges whose triangles bend by more than `degrees`, borders and non-manifold edges
/// are hard, all others smooth. Within a smooth fan of a vertex the normal is the mean of the face normals weighted by
/// corner angle. Vertices are doubled along hard edges and joined where only their old normals differed.
void rebuildNormals(CombinedMesh& mesh, double degrees);

}  // namespace jalousie::bake
