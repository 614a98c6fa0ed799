// Finds vertices at equal positions.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace jalousie::bake {

/// Moves every position to the first one within `distance` of it, in the order given. Positions are finite. O(n) for
/// positions that are spread out. @return  how many moved
std::uint64_t snapPositions(std::vector<glm::vec3>& positions, double distance);

/// For each position, the lowest index that holds the same position (-0 equals 0). O(n log n), deterministic.
std::vector<std::uint32_t> weldByPosition(std::span<const glm::vec3> positions);

}  // namespace jalousie::bake
