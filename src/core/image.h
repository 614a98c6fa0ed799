// An 8-bit RGBA image in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace jalousie {

/// width x height pixels, 4 bytes each (R, G, B, A), row 0 at the top, no padding.
struct ImageRgba8 {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> pixels;

  std::size_t offset(std::uint32_t x, std::uint32_t y) const { return (static_cast<std::size_t>(y) * width + x) * 4; }
};

}  // namespace jalousie
