// Plain CPU twin of shaders/visibility/count_pixels.comp: visible pixels of each object (an item buffer, Weghorst,
// Hooper and Greenberg 1984).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace jalousie::visibility {

/// @param items  object index + 1 per pixel, 0 where there is none   @return  pixels per object [objectCount]
std::vector<std::uint32_t> countPixels(std::span<const std::uint32_t> items, std::uint32_t objectCount);

}  // namespace jalousie::visibility
