// Writes the objects and materials of a mesh file into a glTF document.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bake/io/notes.h"
#include "bake/io/polygon_mesh.h"

namespace jalousie::bake {

/// Bytes of a file beside the input; nullopt if it cannot be read.
using PictureSource = std::function<std::optional<std::vector<std::byte>>(const std::string& name)>;

/// Where a mesh comes from.
struct SurfaceSource {
  std::string name;  ///< of objects without one
  NormalRule rule = NormalRule::kNone;
  PictureSource pictures;
};

/// Adds a node with a mesh for each object and the materials that are in use. Pictures are embedded as they are; one
/// that is missing, or is no PNG, JPEG or WebP, is noted and left out. Smooth normals are made where the rule leaves
/// none.
void appendSurface(tinygltf::Model& model, const PolygonMesh& mesh, const SurfaceSource& source, Notes& notes);

}  // namespace jalousie::bake
