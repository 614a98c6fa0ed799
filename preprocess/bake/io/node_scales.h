// How large nodes show their meshes.
#pragma once

#include <tiny_gltf.h>

#include <vector>

namespace jalousie::bake {

/// For each node the length in the scene of one unit of its mesh: the cube root of the determinant of its world
/// transform, so the mean over the axes. 0 if the transform is singular or not finite. Errors: those of localTransform.
std::vector<double> nodeScales(const tinygltf::Model& model);

}  // namespace jalousie::bake
