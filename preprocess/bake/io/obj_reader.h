// Reads OBJ files with their materials.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asset/gltf_file.h"
#include "bake/io/notes.h"
#include "bake/io/polygon_mesh.h"

namespace jalousie::bake {

/// Bytes of the material file with this name; nullopt if it cannot be read.
using MaterialSource = std::function<std::optional<std::vector<std::byte>>(const std::string& name)>;

/// Reads positions with colours (v x y z r g b, as shares of full colour or of 255, taken as sRGB), texture
/// coordinates, normals, polygons, smoothing groups and materials. Each object (o) is one of its own; in files without
/// objects each group (g). Of a material, Kd, d, Ke, Pm, Pr, map_Kd, map_Ke and norm are used. Lines, points, curves
/// and unknown statements are passed over. A material file is read only from inside the folder of the file; one that
/// cannot be read is noted. Errors: kMalformed (with the line's number: not a number, index out of range), kUnsupported
/// (no faces), kLimit. @param observer  called for the MTL files
PolygonMesh readObj(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes,
                    const asset::ReadObserver& observer = {});
/// As readObj, with another source of materials. @param file  for messages
PolygonMesh parseObj(std::span<const std::byte> bytes, const std::filesystem::path& file,
                     const MaterialSource& materials, Notes& notes);

}  // namespace jalousie::bake
