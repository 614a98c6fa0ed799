// Finds meshes of equal content, as kits and building models hold one part many times.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <span>
#include <vector>

namespace jalousie::bake {

/// For each of some meshes the place in the list of the first one that holds the same: primitives of equal mode,
/// material, extensions and extras, whose accessors have equal elements. A mesh that equals no earlier one has its own
/// place, and so has a mesh with morph targets or sparse accessors. Names, extras and extensions of the mesh itself do
/// not count. Time follows the bytes of the accessors. @param meshes  indices   Errors: kMalformed (an accessor).
std::vector<std::size_t> findEqualMeshes(const tinygltf::Model& model, std::span<const std::size_t> meshes);

}  // namespace jalousie::bake
