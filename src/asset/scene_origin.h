// The point that a scene's transforms are relative to.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "asset/scene_types.h"

namespace jalousie::asset::detail {

/// Exact world positions of what a scene places.
struct Places {
  std::span<const glm::dvec3> instances;       ///< origins of SceneFile::instances
  std::span<const glm::dvec3> looseInstances;  ///< origins of SceneFile::looseInstances
};

/// Places instances and cameras relative to the middle of a scene that is more than 16 of its diagonals away from the
/// document's origin, and sets SceneFile::originWorld. A float has 24 digits: at a distance of 10^6 it knows places to
/// 1/16. Other scenes stay as they are.
void placeNearOrigin(SceneFile& scene, const Places& places);

/// Makes the vertices of animated skins relative to SceneFile::originWorld, as their joints are, instead of their
/// instances. @param instances  as Places
void placeSkins(SceneFile& scene, std::span<const glm::dvec3> instances);

}  // namespace jalousie::asset::detail
