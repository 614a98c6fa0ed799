// The largest rectangle of free cells.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace jalousie::bake {

/// Cells from `low` to before `high`.
struct CellRectangle {
  glm::uvec2 low{0U};
  glm::uvec2 high{0U};
  std::uint64_t area() const { return std::uint64_t{high.x - low.x} * (high.y - low.y); }
};

/// The first of the largest rectangles whose cells are all free; an empty one if none is. O(columns * cells).
/// @param isFree  row by row; not 0: free   @param columns  of a row
CellRectangle largestRectangle(std::span<const std::uint8_t> isFree, std::uint32_t columns);

}  // namespace jalousie::bake
