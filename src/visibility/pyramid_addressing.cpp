// Rounds outwards to whole pixels and shifts to the level.
#include "visibility/pyramid_addressing.h"

#include <algorithm>
#include <cmath>

#include "shared/limits.h"

namespace jalousie::visibility {

std::uint32_t levelForExtent(float extentPixels) {
  std::uint32_t level = 0;
  while (level < 31 && static_cast<float>(1U << level) < extentPixels)
    ++level;
  return level;
}

TexelRange touchedPixels(const glm::vec4& rect, std::uint32_t width, std::uint32_t height) {
  const auto first = [](float lower, std::uint32_t limit) {
    return std::min(static_cast<std::uint32_t>(std::floor(lower)), limit - 1);
  };
  const auto last = [](float upper, std::uint32_t start, std::uint32_t limit) {
    return std::max(std::min(static_cast<std::uint32_t>(std::ceil(upper)), limit), start + 1) - 1;
  };
  const std::uint32_t firstX = first(rect.x, width);
  const std::uint32_t firstY = first(rect.y, height);
  return {firstX, firstY, last(rect.z, firstX, width), last(rect.w, firstY, height)};
}

BlockSpan blockSpan(std::uint32_t firstPixel, std::uint32_t lastPixel, float lower, float upper, std::uint32_t level) {
  BlockSpan span{firstPixel >> level, (lastPixel >> level) - (firstPixel >> level) + 1};
  if (span.count <= gpu::kMaxBlockSide) return span;
  const auto size = static_cast<float>(1U << level);
  const float coveredFirst = static_cast<float>(span.first + 1) * size - lower;
  const float coveredLast = upper - static_cast<float>(span.first + span.count - 1) * size;
  if (coveredFirst < coveredLast) ++span.first;
  span.count = gpu::kMaxBlockSide;
  return span;
}

}  // namespace jalousie::visibility
