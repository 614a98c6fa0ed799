// Reads PLY files: ASCII, binary little and big endian. Every count is checked against the size of the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "bake/io/notes.h"
#include "bake/io/polygon_mesh.h"

namespace jalousie::bake {

/// Reads vertex positions, normals (nx ny nz), texture coordinates (s t, u v, texture_u texture_v), colours (red green
/// blue alpha, r g b a, diffuse_red ..., taken as sRGB: floats in [0, 1], ushort in [0, 65535], other integers in [0,
/// 255]), faces (vertex_indices or vertex_index, with texcoord and texnumber) and strips (tristrips). Each "comment
/// TextureFile" is a material. Other elements and properties are skipped; what may be missed is noted.
/// @param file  names the input in errors. Errors: kMalformed (header, truncated data, index out of range, a number
/// that is NaN or infinite, a colour out of its range), kUnsupported (no faces), kLimit.
PolygonMesh readPly(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes);

}  // namespace jalousie::bake
