// For each cell the height of what is free above it, widened to the right as far as it stays free.
#include "bake/mesh/largest_rectangle.h"

#include <algorithm>
#include <vector>

namespace jalousie::bake {

CellRectangle largestRectangle(std::span<const std::uint8_t> isFree, std::uint32_t columns) {
  CellRectangle best;
  std::vector<std::uint32_t> height(columns, 0);
  for (std::uint32_t y = 0; (std::size_t{y} + 1) * columns <= isFree.size(); ++y) {
    for (std::uint32_t x = 0; x < columns; ++x)
      height[x] = isFree[std::size_t{y} * columns + x] != 0 ? height[x] + 1 : 0;
    for (std::uint32_t x = 0; x < columns; ++x) {
      std::uint32_t lowest = height[x];
      for (std::uint32_t end = x; end < columns && (lowest = std::min(lowest, height[end])) > 0; ++end) {
        const CellRectangle found{{x, y + 1 - lowest}, {end + 1, y + 1}};
        if (found.area() > best.area()) best = found;
      }
    }
  }
  return best;
}

}  // namespace jalousie::bake
