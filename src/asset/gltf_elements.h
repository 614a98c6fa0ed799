// JSON of the elements that large documents have many of. tinygltf's writer copies each of them several times.
#pragma once

#include <tiny_gltf.h>

#include <nlohmann/json_fwd.hpp>

namespace jalousie::asset::detail {

/// Takes accessors, buffer views, meshes and nodes out of a model. @return  an object with their arrays, under the
/// names that glTF gives them; those without elements are absent
nlohmann::json takeElements(tinygltf::Model& model);

}  // namespace jalousie::asset::detail
