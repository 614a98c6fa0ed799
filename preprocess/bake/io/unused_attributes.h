// Finds vertex attributes that no material of their primitive uses.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace jalousie::bake {

/// Names of attributes that at least one primitive of the mesh has without use, in ascending order: texture
/// coordinates that no texture of its materials reads, and tangents without a normal map. Materials of
/// KHR_materials_variants count. Everything else is taken for used, and so is everything in a primitive without a
/// material: the program that shows it decides.
std::vector<std::string> unusedAttributes(const tinygltf::Model& model, const tinygltf::Mesh& mesh);

/// A copy of the mesh whose primitives are without the attributes that they do not use.
tinygltf::Mesh withoutUnused(const tinygltf::Model& model, const tinygltf::Mesh& mesh);

}  // namespace jalousie::bake
