// Builds the pyramid of the mask from the largest of 2x2 texels.
#include "visibility/importance_mask.h"

#include <algorithm>
#include <bit>

#include "shared/limits.h"
#include "visibility/pyramid_addressing.h"

namespace jalousie::visibility {
namespace {

std::uint8_t luminance(const std::uint8_t* rgba) {
  return static_cast<std::uint8_t>((2126U * rgba[0] + 7152U * rgba[1] + 722U * rgba[2] + 5000U) / 10000U);
}

}  // namespace

std::uint32_t ImportanceMask::levelWidth(std::uint32_t level) const {
  return std::max(std::bit_ceil(width_) >> level, 1U);
}

std::uint32_t ImportanceMask::levelHeight(std::uint32_t level) const {
  return std::max(std::bit_ceil(height_) >> level, 1U);
}

ImportanceMask::ImportanceMask(const ImageRgba8& image) : width_(image.width), height_(image.height) {
  levels_.emplace_back(std::size_t{levelWidth(0)} * levelHeight(0));
  for (std::uint32_t y = 0; y < height_; ++y)
    for (std::uint32_t x = 0; x < width_; ++x)
      levels_[0][std::size_t{y} * levelWidth(0) + x] = luminance(&image.pixels[image.offset(x, height_ - 1 - y)]);
  const auto count = static_cast<std::uint32_t>(std::bit_width(std::max(levelWidth(0), levelHeight(0))));
  for (std::uint32_t level = 1; level < count; ++level) {
    const std::uint32_t fineWidth = levelWidth(level - 1);
    const std::uint32_t fineHeight = levelHeight(level - 1);
    std::vector<std::uint8_t> coarse(std::size_t{levelWidth(level)} * levelHeight(level));
    for (std::uint32_t y = 0; y < fineHeight; ++y) {
      for (std::uint32_t x = 0; x < fineWidth; ++x) {
        std::uint8_t& target = coarse[std::size_t{y / 2} * levelWidth(level) + x / 2];
        target = std::max(target, levels_[level - 1][std::size_t{y} * fineWidth + x]);
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

float ImportanceMask::largestIn(const glm::vec4& rect, std::uint32_t viewportWidth,
                                std::uint32_t viewportHeight) const {
  const glm::vec4 viewport(viewportWidth, viewportHeight, viewportWidth, viewportHeight);
  const glm::vec4 scaled = rect / viewport * glm::vec4(width_, height_, width_, height_);
  const TexelRange pixels = touchedPixels(scaled, width_, height_);
  const std::uint32_t level =
      std::min(levelForExtent(std::max(scaled.z - scaled.x, scaled.w - scaled.y)), levels() - 1);
  const TexelRange texels = pixels.atLevel(level);
  float importance = gpu::kLeastImportance;
  for (std::uint32_t y = texels.firstY; y <= texels.lastY; ++y)
    for (std::uint32_t x = texels.firstX; x <= texels.lastX; ++x)
      importance =
          std::max(importance, static_cast<float>(levels_[level][std::size_t{y} * levelWidth(level) + x]) / 255.0F);
  return importance;
}

}  // namespace jalousie::visibility
