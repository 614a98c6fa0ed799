// Finds vertices at equal positions.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace jalousie::bake {

/// For each position, the lowest index that holds the same position (-0 equals 0). O(n log n), deterministic.
std::vector<std::uint32_t> weldByPosition(std::span<const glm::vec3> positions);

}  // namespace jalousie::bake
