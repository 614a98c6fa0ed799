// Recognises flat shading and restores it after the triangles have changed.
#pragma once

#include <vector>

#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

/// For each primitive whether it is shaded flat: it has triangles that bend against each other, and the normals of
/// nearly all corners are those of their triangles. Empty if no primitive is.
std::vector<bool> flatPrimitives(const WedgeMesh& mesh);

/// Gives the triangles of flat primitives their own normals. Corners at one vertex share a wedge if all their
/// attributes and the directions of their triangles are equal. @param flat  from flatPrimitives of LOD 0
void restoreFlatShading(const std::vector<bool>& flat, WedgeMesh& level);

}  // namespace jalousie::bake
