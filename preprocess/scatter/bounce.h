// Objects that bounce in the cube: paths in closed form, so that a frame is the same frame in every program.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/random.h"
#include "scatter/layout.h"

namespace jalousie::scatter {

/// Where the centre of an object is at some times; straight lines between them.
struct BouncePath {
  std::vector<float> times;  ///< seconds, ascending from 0 to the last second
  std::vector<glm::vec3> positions;
};

/// Moves along a straight line that the sides of [-halfSide, halfSide]^3 reflect: per axis a triangle wave.
/// @param start  in the cube   @param velocity  world units a second   @param seconds  of the last key
BouncePath bouncePath(const glm::dvec3& start, const glm::dvec3& velocity, double halfSide, double seconds);

/// A placement and how it moves.
struct Mover {
  std::uint32_t object = 0;  ///< index in the placements
  glm::dvec3 velocity{0.0};
};

/// Which objects move: each but the one in the middle with a probability of `share`, in a random direction, through the
/// cube in 5 to 20 seconds; on the ground in a random direction of the plane. Deterministic in the layout; placements
/// do not depend on it. @param side  of the cube or square, world units
std::vector<Mover> chooseMovers(const Layout& layout, float side);

}  // namespace jalousie::scatter
