// Cameras and their motion into a glTF model.
#pragma once

#include <tiny_gltf.h>

#include <string>

#include "asset/scene_types.h"

namespace jalousie::asset {

/// Adds a perspective camera, a node that holds it and, if the track has keys, an animation of that node with linear
/// interpolation. The node stands at the track's first keys. If camera.worldFromParent moves it, a node above it does.
/// @param name  of camera and animation   @return index of the uppermost node, which is in no scene yet
/// @pre camera is perspective, and camera.worldFromParent is a translation (checked)
int appendCamera(tinygltf::Model& model, const std::string& name, const Camera& camera);

}  // namespace jalousie::asset
