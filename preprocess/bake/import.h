// Any supported file as a glTF document.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <vector>

#include "asset/gltf_file.h"

namespace jalousie::bake {

/// Reads .ply, .obj, .gltf or .glb by the file's extension. One glTF input stays as it is; PLY and OBJ files become one
/// mesh and node each, in the order given, with smooth normals where the file has none. Errors: kUsage (several inputs
/// of which one is glTF), kUnsupported (another extension), and those of the readers.
tinygltf::Model importFiles(const std::vector<std::filesystem::path>& files, const asset::Limits& limits);

}  // namespace jalousie::bake
