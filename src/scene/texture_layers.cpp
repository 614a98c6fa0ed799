// Sorts textures by size and makes their mip levels. The mip levels are made here, not by the driver, so that they are
// the same on every machine and masked textures keep their coverage (Castano 2010, "Computing alpha mipmaps").
#include "scene/texture_layers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

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

/// Mean of 2x2 texels into one of the next level; of two along a side that has one texel.
void averageTexel(const ImageRgba8& fine, std::uint32_t x, std::uint32_t y, std::uint8_t* target) {
  const std::array<float, 256>& linear = linearTable();
  std::array<float, 3> weighted = {};
  std::array<float, 3> plain = {};
  float alpha = 0.0F;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint8_t* texel = &fine.pixels[fine.offset(std::min(2 * x + (k & 1U), fine.width - 1),
                                                         std::min(2 * y + (k >> 1U), fine.height - 1))];
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
  ImageRgba8 coarse{std::max(fine.width / 2, 1U), std::max(fine.height / 2, 1U), {}};
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

/// Each texel from the one that its centre lies in.
ImageRgba8 enlarged(const ImageRgba8& source, std::uint32_t width, std::uint32_t height) {
  ImageRgba8 result{width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height)};
  for (std::uint32_t y = 0; y < height; ++y) {
    const auto row =
        static_cast<std::uint32_t>((2 * std::uint64_t{y} + 1) * source.height / (2 * std::uint64_t{height}));
    for (std::uint32_t x = 0; x < width; ++x) {
      const auto column =
          static_cast<std::uint32_t>((2 * std::uint64_t{x} + 1) * source.width / (2 * std::uint64_t{width}));
      std::copy_n(&source.pixels[source.offset(column, row)], 4, &result.pixels[result.offset(x, y)]);
    }
  }
  return result;
}

/// The array textures decode sRGB: colours become bytes whose decoded value is the old byte / 255.
void encodeData(ImageRgba8& image) {
  std::array<std::uint8_t, 256> encoded = {};
  for (std::size_t i = 0; i < encoded.size(); ++i)
    encoded[i] = toByte(srgbFromLinear(static_cast<float>(i) / 255.0F));
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (i % 4 != 3) image.pixels[i] = encoded[image.pixels[i]];
}

/// A class while classes are merged.
struct Group {
  TextureClass size;
  std::vector<std::size_t> images;
};

TextureClass merged(const TextureClass& a, const TextureClass& b) {
  return {std::max(a.width, b.width), std::max(a.height, b.height), a.layers + b.layers};
}

/// One group for each size that an image needs.
std::vector<Group> groupsBySize(std::span<const asset::ImageSize> images, std::uint32_t maxSide) {
  const std::uint32_t most = std::bit_floor(maxSide);
  const auto side = [most](std::uint32_t pixels) { return std::bit_ceil(std::clamp(pixels, 1U, most)); };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Group> groups;
  for (std::size_t i = 0; i < images.size(); ++i) {
    Group& group = groups[{side(images[i].width), side(images[i].height)}];
    group.size = {side(images[i].width), side(images[i].height), group.size.layers + 1};
    group.images.push_back(i);
  }
  std::vector<Group> result;
  result.reserve(groups.size());
  for (auto& [size, group] : groups)
    result.push_back(std::move(group));
  return result;
}

/// The pair of groups whose merger adds the fewest texels.
struct Merger {
  std::size_t first = 0;
  std::size_t second = 0;
  std::uint64_t added = std::numeric_limits<std::uint64_t>::max();  ///< texels
};

Merger cheapestMerger(const std::vector<Group>& groups) {
  Merger best;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (std::size_t k = i + 1; k < groups.size(); ++k) {
      const TextureClass& a = groups[i].size;
      const TextureClass& b = groups[k].size;
      const std::uint64_t added = merged(a, b).texels() - a.texels() - b.texels();
      if (added < best.added) best = {i, k, added};
    }
  }
  return best;
}

void mergeGroups(std::vector<Group>& groups) {
  std::uint64_t needed = 0;
  for (const Group& group : groups)
    needed += group.size.texels();
  constexpr std::uint32_t kLayers = 2048;  // the most that OpenGL 4.5 promises
  std::uint64_t spare = needed / 4;
  while (groups.size() > 1) {
    const Merger best = cheapestMerger(groups);
    const std::uint32_t layers = groups[best.first].size.layers + groups[best.second].size.layers;
    if (groups.size() <= gpu::kTextureClasses && (best.added > spare || layers > kLayers)) return;
    spare -= std::min(spare, best.added);
    Group& target = groups[best.first];
    Group& source = groups[best.second];
    target.size = merged(target.size, source.size);
    target.images.insert(target.images.end(), source.images.begin(), source.images.end());
    groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(best.second));
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
  while (std::max(levels.back().width, levels.back().height) > 1)
    levels.push_back(halved(levels.back()));
  const bool masked = alphaCutoff && *alphaCutoff > 0.0F && *alphaCutoff <= 1.0F;
  if (!masked) return levels;
  const float coverage = alphaCoverage(image, *alphaCutoff);
  for (std::size_t level = 1; level < levels.size(); ++level)
    restoreCoverage(levels[level], *alphaCutoff, coverage);
  return levels;
}

TextureLayout layoutTextures(std::span<const asset::ImageSize> images, std::uint32_t maxSide) {
  std::vector<Group> groups = groupsBySize(images, maxSide);
  mergeGroups(groups);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.size.layerTexels() > b.size.layerTexels(); });
  TextureLayout layout;
  layout.slots.resize(images.size());
  for (Group& group : groups) {
    std::sort(group.images.begin(), group.images.end());
    for (std::uint32_t layer = 0; layer < group.images.size(); ++layer)
      layout.slots[group.images[layer]] = {static_cast<std::uint32_t>(layout.classes.size()), layer};
    layout.classes.push_back(group.size);
  }
  return layout;
}

TextureLayers makeTextureLayers(const SharedVector<ImageRgba8>& images, const std::vector<LayerUse>& uses,
                                std::uint32_t maxSide) {
  std::vector<asset::ImageSize> sizes;
  for (const ImageRgba8& image : images)
    sizes.push_back({image.width, image.height});
  TextureLayers result{layoutTextures(sizes, maxSide), images, uses};
  result.uses.resize(images.size());
  return result;
}

std::vector<ImageRgba8> makeLayer(const TextureLayers& textures, std::size_t image) {
  const TextureClass& size = textures.layout.classes[textures.layout.slots[image].textureClass];
  const ImageRgba8& source = textures.images[image];
  const LayerUse& use = textures.uses[image];
  const bool fits = source.width == size.width && source.height == size.height;
  ImageRgba8 layer = fits            ? source
                     : use.isNearest ? enlarged(source, size.width, size.height)
                                     : asset::resizeImage(source, size.width, size.height);
  if (use.isData) encodeData(layer);
  return makeMipLevels(layer, use.alphaCutoff);
}

}  // namespace jalousie::scene
