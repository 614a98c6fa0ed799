// Affine transforms as three rows.
#pragma once

#include <glm/glm.hpp>

#include "shared/scene_structs.h"

namespace jalousie::scene {

/// A matrix as three rows, and back. @pre the last row is 0 0 0 1
gpu::Transform makeTransform(const glm::mat4& worldFromObject);
glm::mat4 worldFromObject(const gpu::Transform& transform);

}  // namespace jalousie::scene
