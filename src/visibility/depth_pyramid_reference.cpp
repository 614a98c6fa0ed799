// Builds the pyramid by taking the farthest of 2x2 texels; GPU twin: shaders/visibility/reduce_depth.comp.
#include "visibility/depth_pyramid_reference.h"

#include <algorithm>

#include "core/check.h"

namespace jalousie::visibility {

DepthPyramidReference::DepthPyramidReference(const MapLayout& layout, std::span<const float> depth, bool covered)
    : layout_(layout) {
  JAL_CHECK(depth.size() == std::size_t{layout.screenWidth} * layout.screenHeight);
  levels_.emplace_back(depth.begin(), depth.end());
  const auto screenDepth = [&](std::uint32_t x, std::uint32_t y) {
    if (x >= layout.screenWidth || y >= layout.screenHeight) return 1.0F;
    const float value = depth[std::size_t{y} * layout.screenWidth + x];
    return covered && value <= 0.0F ? 1.0F : value;
  };
  for (std::uint32_t level = 1; level < layout.levels; ++level) {
    const std::uint32_t fineWidth = layout.levelWidth(level - 1);
    const std::uint32_t fineHeight = layout.levelHeight(level - 1);
    const auto fetch = [&](std::uint32_t x, std::uint32_t y) {
      if (level == 1) return screenDepth(x, y);
      return levels_[level - 1][std::size_t{std::min(y, fineHeight - 1)} * fineWidth + std::min(x, fineWidth - 1)];
    };
    std::vector<float> coarse(std::size_t{layout.levelWidth(level)} * layout.levelHeight(level));
    for (std::uint32_t y = 0; y < layout.levelHeight(level); ++y)
      for (std::uint32_t x = 0; x < layout.levelWidth(level); ++x)
        coarse[std::size_t{y} * layout.levelWidth(level) + x] = std::min(
            {fetch(2 * x, 2 * y), fetch(2 * x + 1, 2 * y), fetch(2 * x, 2 * y + 1), fetch(2 * x + 1, 2 * y + 1)});
    levels_.push_back(std::move(coarse));
  }
}

float DepthPyramidReference::farthest(std::uint32_t x, std::uint32_t y, std::uint32_t level) const {
  JAL_CHECK(level < layout_.levels);
  const std::uint32_t width = level == 0 ? layout_.screenWidth : layout_.levelWidth(level);
  JAL_CHECK(x < width);
  return levels_[level].at(std::size_t{y} * width + x);
}

}  // namespace jalousie::visibility
