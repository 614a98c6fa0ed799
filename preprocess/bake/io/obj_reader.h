// Reads OBJ files with tinyobjloader, from memory, and checks every index again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asset/gltf_file.h"
#include "bake/mesh/triangle_mesh.h"

namespace jalousie::bake {

/// Triangles of one material.
struct ObjPart {
  std::string material;       ///< name; empty if none
  glm::vec4 baseColor{1.0F};  ///< linear, from Kd and d of the MTL file
  TriangleMesh mesh;
};

/// Bytes of the material file with this name; nullopt if it cannot be read.
using MaterialSource = std::function<std::optional<std::vector<std::byte>>(const std::string& name)>;

/// Reads an OBJ file. MTL files are read only from inside its folder; materials that cannot be read are left out.
/// Polygons are triangulated. Errors: kMalformed (parse error, index out of range, NaN), kUnsupported (no
/// faces), kLimit.
/// @param observer  called for the MTL files
std::vector<ObjPart> readObj(std::span<const std::byte> bytes, const std::filesystem::path& file,
                             const asset::ReadObserver& observer = {});
/// As readObj, with another source of materials. @param file  for messages
std::vector<ObjPart> parseObj(std::span<const std::byte> bytes, const std::filesystem::path& file,
                              const MaterialSource& materials);

}  // namespace jalousie::bake
