// Reads STL files, binary and ASCII.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "bake/io/notes.h"
#include "bake/io/polygon_mesh.h"

namespace jalousie::bake {

/// Corners at equal places become one vertex. Normals of the file are not used: many programs write none. Each solid of
/// an ASCII file is an object. @param file  names the input in errors. @param notes  gets what is left out: colours of
/// facets, bytes after the last one. Errors: kMalformed (neither kind, cut off, not a finite number), kUnsupported (no
/// triangles), kLimit.
PolygonMesh readStl(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes);

}  // namespace jalousie::bake
