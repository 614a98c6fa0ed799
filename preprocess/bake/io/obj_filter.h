// Checks the statements of an OBJ file and keeps those that make up its mesh.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace jalousie::bake {

/// Rewrites an OBJ file to `v x y z`, `vn x y z`, `vt u v`, `f` with 3 to 255 corners, `usemtl` and `mtllib`. Every
/// number is finite, and every corner has the form i, i/t, i//n or i/t/n. Continued lines are joined and larger
/// polygons are split into fans. Groups, lines, points, subdivision tags, weights and comments are removed. Errors:
/// kMalformed (with the line's number), kLimit (names or numbers that are too long)
std::string filteredObj(std::span<const std::byte> bytes, const std::filesystem::path& file);

}  // namespace jalousie::bake
