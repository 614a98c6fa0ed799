// Overlap test with at most two descents, then the DCT of one block (thesis Algorithm 3.1).
#include "visibility/overlap_reference.h"

#include <algorithm>
#include <cmath>

#include "shared/limits.h"

namespace jalousie::visibility {
namespace {

struct Range {
  float lowest = 1.0F;
  float highest = 0.0F;
};

Range opacityRange(const OcclusionMapReference& map, const TexelRange& pixels, std::uint32_t level) {
  const TexelRange texels = pixels.atLevel(level);
  Range range;
  for (std::uint32_t y = texels.firstY; y <= texels.lastY; ++y) {
    for (std::uint32_t x = texels.firstX; x <= texels.lastX; ++x) {
      const float value = map.opacity(x, y, level);
      range.lowest = std::min(range.lowest, value);
      range.highest = std::max(range.highest, value);
    }
  }
  return range;
}

std::uint32_t lomOf(const OcclusionMapReference& map, const gpu::ScreenRect& rect) {
  return std::min(levelForExtent(std::max(rect.maxX - rect.minX, rect.maxY - rect.minY)), map.layout().levels - 1);
}

}  // namespace

std::uint32_t levelForExtent(float extentPixels) {
  std::uint32_t level = 0;
  while (level < 31 && static_cast<float>(1U << level) < extentPixels)
    ++level;
  return level;
}

TexelRange touchedPixels(const gpu::ScreenRect& rect, std::uint32_t width, std::uint32_t height) {
  const auto first = [](float lower, std::uint32_t limit) {
    return std::min(static_cast<std::uint32_t>(std::floor(lower)), limit - 1);
  };
  const auto last = [](float upper, std::uint32_t start, std::uint32_t limit) {
    return std::max(std::min(static_cast<std::uint32_t>(std::ceil(upper)), limit), start + 1) - 1;
  };
  const std::uint32_t firstX = first(rect.minX, width);
  const std::uint32_t firstY = first(rect.minY, height);
  return {firstX, firstY, last(rect.maxX, firstX, width), last(rect.maxY, firstY, height)};
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

AnalysedBlock analysedBlock(const OcclusionMapReference& map, const gpu::ScreenRect& rect) {
  const TexelRange pixels = touchedPixels(rect, map.layout().screenWidth, map.layout().screenHeight);
  const std::uint32_t lom = lomOf(map, rect);
  AnalysedBlock block;
  block.level = lom > gpu::kBlockLevels ? lom - gpu::kBlockLevels : 0;
  block.x = blockSpan(pixels.firstX, pixels.lastX, rect.minX, rect.maxX, block.level);
  block.y = blockSpan(pixels.firstY, pixels.lastY, rect.minY, rect.maxY, block.level);
  for (std::uint32_t j = 0; j < block.y.count; ++j)
    for (std::uint32_t i = 0; i < block.x.count; ++i)
      block.opacity.push_back(map.opacity(block.x.first + i, block.y.first + j, block.level));
  return block;
}

OverlapResult testOverlap(const OcclusionMapReference& map, const gpu::ScreenRect& rect, float cullThreshold) {
  const TexelRange pixels = touchedPixels(rect, map.layout().screenWidth, map.layout().screenHeight);
  const std::uint32_t lom = lomOf(map, rect);
  const std::uint32_t lowest = lom > gpu::kMaxDescent ? lom - gpu::kMaxDescent : 0;
  Range range = opacityRange(map, pixels, lom);
  for (std::uint32_t level = lom; range.lowest < cullThreshold && range.highest > 0.0F && level > lowest;)
    range = opacityRange(map, pixels, --level);

  if (range.lowest >= cullThreshold) return {gpu::kVerdictOccluded, 1.0F};
  if (range.highest <= 0.0F) return {gpu::kVerdictOpen, -1.0F};
  const AnalysedBlock block = analysedBlock(map, rect);
  return {gpu::kVerdictPartial, levelOfVisibilityOfOpacity({block.x.count, block.y.count, block.opacity})};
}

}  // namespace jalousie::visibility
