// Counts the item buffer pixel by pixel.
#include "visibility/item_buffer.h"

#include "core/check.h"

namespace jalousie::visibility {

std::vector<std::uint32_t> countPixels(std::span<const std::uint32_t> items, std::uint32_t objectCount) {
  std::vector<std::uint32_t> counts(objectCount);
  for (const std::uint32_t item : items) {
    JAL_CHECK(item <= objectCount);
    if (item > 0) ++counts[item - 1];
  }
  return counts;
}

}  // namespace jalousie::visibility
