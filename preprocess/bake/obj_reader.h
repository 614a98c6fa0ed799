// OBJ through tinyobjloader, from memory, with every index checked again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bake/triangle_mesh.h"

namespace jalousie::bake {

/// Triangles of one material.
struct ObjPart {
  std::string material;       ///< name; empty if none
  glm::vec4 baseColor{1.0F};  ///< linear, from Kd and d of the MTL file
  TriangleMesh mesh;
};

/// Reads an OBJ file; the MTL files it names are read only if they lie in the same folder. Polygons are triangulated.
/// Errors: kMalformed (parse error, index out of range, NaN, no faces), kLimit.
std::vector<ObjPart> readObj(std::span<const std::byte> bytes, const std::filesystem::path& file);

}  // namespace jalousie::bake
