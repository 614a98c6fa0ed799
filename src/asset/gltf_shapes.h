// Checks the shape of glTF JSON where tinygltf ignores values of the wrong shape.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace jalousie::asset::detail {

/// Checks that lists are arrays, that nodes and materials hold as many numbers as glTF requires, and that required
/// members exist. tinygltf ignores members of another shape, so the loaded document would differ from the file.
/// @pre every top-level member of a known name is an array of objects. Errors: kMalformed.
void checkShapes(const nlohmann::json& document, const std::filesystem::path& file);

}  // namespace jalousie::asset::detail
