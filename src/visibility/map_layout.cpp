// Pads the screen to powers of two.
#include "visibility/map_layout.h"

#include <algorithm>
#include <bit>

#include "core/check.h"

namespace jalousie::visibility {

MapLayout mapLayout(std::uint32_t screenWidth, std::uint32_t screenHeight) {
  JAL_CHECK(std::min(screenWidth, screenHeight) >= 1U);
  JAL_CHECK(std::max(screenWidth, screenHeight) <= 16384U);
  MapLayout layout{screenWidth, screenHeight, std::bit_ceil(screenWidth), std::bit_ceil(screenHeight), 1};
  layout.levels = static_cast<std::uint32_t>(std::bit_width(std::max(layout.width, layout.height)));
  return layout;
}

}  // namespace jalousie::visibility
