// A camera that walks from the start of a level to the place that is farthest to walk to.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "wad/level_plan.h"

namespace jalousie::wad {

inline constexpr double kEyeHeight = 41.0;  ///< above the floor, units of the level

/// Keys of a camera that looks where it goes; scene units. Empty where nobody can walk.
struct WalkPath {
  std::vector<float> times;  ///< seconds
  std::vector<glm::vec3> positions;
  std::vector<glm::quat> rotations;
};

/// The shortest way over a grid from the first player's start to the farthest place, around what is too low, too high
/// or too near to a wall. Doors are as they are in the level; lifts and teleporters are not used.
WalkPath walkThrough(const Level& level, const LevelPlan& plan);

/// Floor of the room at a place, units of the level; nullopt outside.
std::optional<double> floorAt(const LevelPlan& plan, const glm::dvec2& place);

}  // namespace jalousie::wad
