// Bakes a LOD chain for every mesh of a document.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bake/io/bake_options.h"
#include "bake/io/mesh_report.h"

namespace jalousie::bake {

/// Bakes every mesh that a node uses, once; nodes that share a mesh share its levels. Lower levels are nodes in no
/// scene with the same transform (and instances). Everything else in the document stays as it is.
/// @param progress  meshes done, of how many, and what the current one is at. Errors: kMalformed, kUnsupported, kLimit,
/// each naming the mesh.
std::vector<MeshReport> bakeDocument(tinygltf::Model& model, const BakeOptions& options,
                                     const std::function<void(std::size_t, std::size_t, const std::string&)>& progress);

}  // namespace jalousie::bake
