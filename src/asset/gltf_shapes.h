// The shape of glTF JSON where tinygltf passes over what does not fit.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace jalousie::asset::detail {

/// Checks that lists are lists, that numbers of nodes and materials are as many as they must be, and that required
/// members are there: tinygltf leaves out what has another shape, and a document would mean something else than it
/// says.
/// @pre every top-level member of a known name is an array of objects. Errors: kMalformed.
void checkShapes(const nlohmann::json& document, const std::filesystem::path& file);

}  // namespace jalousie::asset::detail
