// The triangles of one level as places, for searches that ignore all other attributes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace jalousie::bake {

/// Object space. Indices come in threes, in range.
struct LevelSurface {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
};

/// For each position the first one at the same place.
std::vector<std::uint32_t> firstAtPlace(const LevelSurface& surface);

/// Whether a triangle and a box have a point in common. True where rounding leaves it open (Akenine-Moeller 2001). The
/// triangle may be a segment.
bool touches(const glm::dvec3 (&triangle)[3], const glm::dvec3& center, const glm::dvec3& half);

}  // namespace jalousie::bake
