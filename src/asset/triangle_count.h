// Number of triangles of a glTF primitive.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>

namespace jalousie::asset {

/// Triangles of a list, a strip or a fan, those without area included; 0 for points and lines and without positions.
/// @pre the indices of the primitive's accessors are in range
std::uint64_t triangleCount(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

}  // namespace jalousie::asset
