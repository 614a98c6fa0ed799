// Converts between CombinedMesh, as read and written, and WedgeMesh, as simplified.
#pragma once

#include "bake/mesh/combined_mesh.h"
#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

/// Welds vertices by position and flattens the attributes of all primitives. Vertices without a triangle are left out.
WedgeMesh makeWedges(const CombinedMesh& mesh);

/// Converts back, with the primitives and attributes of `source`. Normals and tangents have unit length.
CombinedMesh combineWedges(const WedgeMesh& mesh, const CombinedMesh& source);

}  // namespace jalousie::bake
