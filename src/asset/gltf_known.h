// Extensions whose references to accessors and vertices are known.
#pragma once

#include <tiny_gltf.h>

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace jalousie::asset {

/// Whether an extension of a primitive may hold indices of vertices, or accessors with one element per vertex: all that
/// are not known and hold an integer.
bool mayReferToVertices(std::string_view name, const tinygltf::Value& extension);

namespace detail {

/// Whether every accessor and buffer view that an extension can refer to is known to findReferences.
bool isKnownExtension(std::string_view name);

/// Whether a value holds an integer or, as pointers do, names a list of accessors or views. What the baker writes into
/// extras does not count.
bool mayHoldReference(const nlohmann::json& value);

}  // namespace detail
}  // namespace jalousie::asset
