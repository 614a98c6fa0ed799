// Scenes with a camera, as several render tests use them.
#pragma once

#include <glm/glm.hpp>
#include <numbers>

#include "scene/camera.h"
#include "scene/scene_data.h"
#include "support/scenes.h"

namespace jalousie::test {

/// Five rows of spheres behind a perforated double-sided wall, seen through it.
inline asset::SceneFile spheresBehindWall(float openShare, std::uint32_t cells = 24) {
  asset::SceneFile file = sphereChain(5);
  file.materials.push_back({});
  file.materials.back().baseColor = {0.35F, 0.5F, 0.3F, 1.0F};
  file.materials.back().doubleSided = true;
  Random random(21);
  file.meshes.push_back({"wall", {perforatedWall(cells, openShare, random, 1)}});
  file.chains.push_back({"wall", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
  addInstance(file, 1, {0, 0, 0}, {2.6F, 2.0F, 1});
  for (int row = 0; row < 5; ++row)
    for (int column = -4; column <= 4; ++column)
      addInstance(file, 0, {1.1F * static_cast<float>(column), 1.1F * static_cast<float>(row - 2), -4.0F},
                  glm::vec3(0.45F));
  return file;
}

/// The camera in front of that wall; the wall is nearer than kWallOccluderDistance, the spheres are not.
inline scene::Camera cameraBeforeWall(const Aabb& boundsWorld) {
  return scene::lookAt({0, 0, 6}, {0, 0, 0}, boundsWorld);
}
inline constexpr float kWallOccluderDistance = 6.5F;

}  // namespace jalousie::test
