// Resamples textures to one size and makes their mip levels. Layers of one size need more memory, but all draws can use
// one texture. The mip levels are made here, not by the driver, so that they are the same on every machine and masked
// textures keep their coverage (Castano 2010, "Computing alpha mipmaps").
#include "scene/texture_layers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "asset/image_io.h"

namespace jalousie::scene {
namespace {

float linearFromSrgb(float value) {
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

float srgbFromLinear(float value) {
  return value <= 0.0031308F ? 12.92F * value : 1.055F * std::pow(value, 1.0F / 2.4F) - 0.055F;
}

std::uint8_t toByte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

const std::array<float, 256>& linearTable() {
  static const std::array<float, 256> kTable = [] {
    std::array<float, 256> table = {};
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = linearFromSrgb(static_cast<float>(i) / 255.0F);
    return table;
  }();
  return kTable;
}

/// Mean of 2x2 texels into one of the next level.
void averageTexel(const ImageRgba8& fine, std::uint32_t x, std::uint32_t y, std::uint8_t* target) {
  const std::array<float, 256>& linear = linearTable();
  std::array<float, 3> weighted = {};
  std::array<float, 3> plain = {};
  float alpha = 0.0F;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint8_t* texel = &fine.pixels[fine.offset(2 * x + (k & 1U), 2 * y + (k >> 1U))];
    alpha += texel[3];
    for (std::size_t c = 0; c < 3; ++c) {
      weighted[c] += static_cast<float>(texel[3]) * linear[texel[c]];
      plain[c] += linear[texel[c]];
    }
  }
  for (std::size_t c = 0; c < 3; ++c)
    target[c] = toByte(srgbFromLinear(alpha > 0.0F ? weighted[c] / alpha : plain[c] / 4.0F));
  target[3] = toByte(alpha / (4.0F * 255.0F));
}

ImageRgba8 halved(const ImageRgba8& fine) {
  ImageRgba8 coarse{fine.width / 2, fine.height / 2, {}};
  coarse.pixels.resize(std::size_t{4} * coarse.width * coarse.height);
  for (std::uint32_t y = 0; y < coarse.height; ++y)
    for (std::uint32_t x = 0; x < coarse.width; ++x)
      averageTexel(fine, x, y, &coarse.pixels[coarse.offset(x, y)]);
  return coarse;
}

/// Scales alpha so that the share of texels at or above the cutoff comes as close to `coverage` as the values allow.
void restoreCoverage(ImageRgba8& image, float cutoff, float coverage) {
  const std::size_t texels = image.pixels.size() / 4;
  std::array<std::size_t, 256> histogram = {};
  for (std::size_t p = 3; p < image.pixels.size(); p += 4)
    ++histogram[image.pixels[p]];
  const double wanted = static_cast<double>(coverage) * static_cast<double>(texels);
  std::size_t reached = 0;
  std::uint32_t threshold = 256;  // nothing passes
  double distance = wanted;
  for (std::uint32_t alpha = 255; alpha >= 1; --alpha) {
    reached += histogram[alpha];
    const double off = std::abs(static_cast<double>(reached) - wanted);
    if (histogram[alpha] == 0 || off > distance) continue;
    distance = off;
    threshold = alpha;
  }
  const float lowest = std::ceil(cutoff * 255.0F);  // the smallest byte that passes
  const float scale = lowest / static_cast<float>(threshold);
  for (std::size_t p = 3; p < image.pixels.size(); p += 4) {
    const float scaled = std::round(scale * static_cast<float>(image.pixels[p]));
    const bool passes = image.pixels[p] >= threshold;
    image.pixels[p] = static_cast<std::uint8_t>(
        std::clamp(passes ? std::max(scaled, lowest) : std::min(scaled, lowest - 1.0F), 0.0F, 255.0F));
  }
}

}  // namespace

float alphaCoverage(const ImageRgba8& image, float cutoff) {
  std::size_t covered = 0;
  for (std::size_t p = 3; p < image.pixels.size(); p += 4)
    covered += static_cast<float>(image.pixels[p]) >= cutoff * 255.0F ? 1 : 0;
  return static_cast<float>(covered) / static_cast<float>(std::max<std::size_t>(image.pixels.size() / 4, 1));
}

std::vector<ImageRgba8> makeMipLevels(const ImageRgba8& image, std::optional<float> alphaCutoff) {
  std::vector<ImageRgba8> levels = {image};
  while (levels.back().width > 1)
    levels.push_back(halved(levels.back()));
  const bool masked = alphaCutoff && *alphaCutoff > 0.0F && *alphaCutoff <= 1.0F;
  if (!masked) return levels;
  const float coverage = alphaCoverage(image, *alphaCutoff);
  for (std::size_t level = 1; level < levels.size(); ++level)
    restoreCoverage(levels[level], *alphaCutoff, coverage);
  return levels;
}

TextureLayers makeTextureLayers(const std::vector<ImageRgba8>& images,
                                const std::vector<std::optional<float>>& alphaCutoffs, std::uint32_t maxSide) {
  TextureLayers result;
  for (const ImageRgba8& image : images)
    result.side = std::max({result.side, image.width, image.height});
  result.side = std::min(std::bit_ceil(result.side), std::bit_floor(maxSide));
  result.layers.reserve(images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const ImageRgba8& image = images[i];
    const bool fits = image.width == result.side && image.height == result.side;
    result.layers.push_back(makeMipLevels(fits ? image : asset::resizeImage(image, result.side, result.side),
                                          i < alphaCutoffs.size() ? alphaCutoffs[i] : std::nullopt));
  }
  return result;
}

}  // namespace jalousie::scene
