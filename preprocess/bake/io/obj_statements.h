// Reads the statements of an OBJ file; materials are names only.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bake/io/notes.h"
#include "bake/io/polygon_mesh.h"

namespace jalousie::bake {

struct ObjStatements {
  PolygonMesh mesh;                    ///< its materials have names only
  std::vector<std::string> libraries;  ///< names after mtllib
};

/// @param notes  gets the statements that are passed over. Errors: kMalformed (with the line's number), kLimit (names
/// or numbers that are too long, too many corners).
ObjStatements readObjStatements(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes);

/// A text without the byte order mark that some editors put before it.
std::string_view withoutByteOrderMark(std::string_view text);

}  // namespace jalousie::bake
