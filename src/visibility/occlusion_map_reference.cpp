// Builds the pyramid by adding 2x2 texels; GPU twin: shaders/visibility/reduce_map.comp.
#include "visibility/occlusion_map_reference.h"

#include <algorithm>

#include "core/check.h"

namespace jalousie::visibility {

OcclusionMapReference::OcclusionMapReference(const MapLayout& layout, std::span<const float> openPixels)
    : layout_(layout) {
  JAL_CHECK(openPixels.size() == std::size_t{layout.screenWidth} * layout.screenHeight);
  levels_.emplace_back(std::size_t{layout.width} * layout.height, 0.0F);
  for (std::uint32_t y = 0; y < layout.screenHeight; ++y)
    std::copy_n(openPixels.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * layout.screenWidth),
                layout.screenWidth, levels_[0].begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * layout.width));
  for (std::uint32_t level = 1; level < layout.levels; ++level) {
    const std::vector<float>& below = levels_.back();
    const std::uint32_t belowWidth = layout.levelWidth(level - 1);
    const std::uint32_t belowHeight = layout.levelHeight(level - 1);
    const auto fetch = [&](std::uint32_t x, std::uint32_t y) {
      return x < belowWidth && y < belowHeight ? below[std::size_t{y} * belowWidth + x] : 0.0F;
    };
    std::vector<float> current(std::size_t{layout.levelWidth(level)} * layout.levelHeight(level));
    for (std::uint32_t y = 0; y < layout.levelHeight(level); ++y)
      for (std::uint32_t x = 0; x < layout.levelWidth(level); ++x)
        current[std::size_t{y} * layout.levelWidth(level) + x] =
            fetch(2 * x, 2 * y) + fetch(2 * x + 1, 2 * y) + fetch(2 * x, 2 * y + 1) + fetch(2 * x + 1, 2 * y + 1);
    levels_.push_back(std::move(current));
  }
}

std::uint32_t OcclusionMapReference::texelArea(std::uint32_t x, std::uint32_t y, std::uint32_t level) const {
  const auto span = [level](std::uint32_t texel, std::uint32_t limit) {
    return std::min((texel + 1) << level, limit) - std::min(texel << level, limit);
  };
  return span(x, layout_.screenWidth) * span(y, layout_.screenHeight);
}

float OcclusionMapReference::opacity(std::uint32_t x, std::uint32_t y, std::uint32_t level) const {
  JAL_CHECK(level < layout_.levels);
  JAL_CHECK(x < layout_.levelWidth(level));
  JAL_CHECK(y < layout_.levelHeight(level));
  const float open = levels_[level][std::size_t{y} * layout_.levelWidth(level) + x];
  return 1.0F - open / static_cast<float>(texelArea(x, y, level));
}

}  // namespace jalousie::visibility
