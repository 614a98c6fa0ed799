// The statements of an OBJ file that make up its mesh, checked, for a parser that checks little.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace jalousie::bake {

/// Rewrites an OBJ file to `v x y z`, `vn x y z`, `vt u v`, `f` with three corners up to 255, `usemtl` and `mtllib`:
/// every number is a finite one, every corner has the shape i, i/t, i//n or i/t/n, continued lines are joined, larger
/// polygons are split into fans, all else (groups, lines, points, subdivision tags, weights, comments) is gone. Errors:
/// kMalformed (with the line's number), kLimit (names or numbers beyond all use).
std::string filteredObj(std::span<const std::byte> bytes, const std::filesystem::path& file);

}  // namespace jalousie::bake
