// CPU twin of the kernels that play animations.
#pragma once

#include "scene/scene_data.h"

namespace jalousie::scene {

/// Gives a scene the pose of a time: transforms, vertices and boxes. GPU twins: all of shaders/motion
void poseScene(SceneData& scene, float seconds);

}  // namespace jalousie::scene
