// Where and how large nodes show their meshes.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <vector>

namespace jalousie::bake {

/// For each node its transform into the scene. Errors: those of localTransform.
std::vector<glm::dmat4> worldTransforms(const tinygltf::Model& model);

/// For each node the length in the scene of one unit of its mesh: the cube root of the determinant of its world
/// transform, so the mean over the axes. 0 if the transform is singular or not finite. Errors: those of localTransform.
std::vector<double> nodeScales(const tinygltf::Model& model);

}  // namespace jalousie::bake
