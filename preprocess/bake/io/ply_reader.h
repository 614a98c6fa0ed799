// Reads PLY files: ASCII, binary little and big endian. Every count is checked against the size of the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "bake/mesh/triangle_mesh.h"

namespace jalousie::bake {

/// Reads vertex positions, normals (nx ny nz), texture coordinates (s t, u v, texture_u texture_v), colours (red green
/// blue alpha, taken as sRGB: floats in [0, 1], ushort in [0, 65535], other integers in [0, 255]) and faces
/// (vertex_indices or vertex_index), polygons split into fans. Other elements and properties are skipped.
/// @param file  names the input in errors. Errors: kMalformed (header, truncated data, index out of range, a number
/// that is NaN or infinite, a colour out of its range), kUnsupported (no faces), kLimit.
TriangleMesh readPly(std::span<const std::byte> bytes, const std::filesystem::path& file);

}  // namespace jalousie::bake
