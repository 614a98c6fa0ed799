// Occluders of the meshes of a baked document.
#pragma once

#include <tiny_gltf.h>

#include "bake/io/bake_options.h"

namespace jalousie::bake {

/// Occluders that the input has are kept, for LOD 0 alone, or left out where --subdivide or --weld moved its vertices.
/// With options.occluders, solids whose box lies inside of all levels hold for all, and meshes without occluders get
/// boxes (innerBoxes) if they are opaque and closed at LOD 0. A box holds up to the first level that is not closed, or
/// for fewer levels where there is none inside all of them. Meshes without a box get large opaque rectangles
/// (largeFacets) of LOD 0.
/// Errors: those of readers.
void bakeOccluders(tinygltf::Model& model, const BakeOptions& options);

}  // namespace jalousie::bake
