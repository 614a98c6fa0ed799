// Rebuilds normals from the surface, with hard edges where it bends.
#pragma once

#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

/// Computes new NORMALs for every primitive. Borders, non-manifold edges and edges whose triangles bend by more than
/// `degrees` are hard; all others are smooth. Within a smooth fan of a vertex the normal is the mean of the face
/// normals weighted by corner angle. Vertices are duplicated along hard edges. Vertices that differed only in their
/// old normals are merged.
void rebuildNormals(CombinedMesh& mesh, double degrees);

}  // namespace jalousie::bake
