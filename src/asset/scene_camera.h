// Cameras of a glTF scene and the animation of their nodes.
#pragma once

#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <optional>

#include "asset/read_limits.h"
#include "asset/scene_types.h"

namespace jalousie::asset::detail {

/// The camera of a node; nullopt for an orthographic one. Errors: kMalformed (a number out of its range).
std::optional<Camera> readCamera(const tinygltf::Model& model, int node, const glm::dmat4& worldFromParent,
                                 const glm::dmat4& worldFromNode, const Limits& limits);

}  // namespace jalousie::asset::detail
