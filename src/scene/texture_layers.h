// Base colour textures as equal layers of one array, so that one draw call can use them all.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.h"

namespace jalousie::scene {

/// Square layers of one size, in the order of the file's images, each with its mip levels.
struct TextureLayers {
  std::uint32_t side = 1;                       ///< pixels, a power of two
  std::vector<std::vector<ImageRgba8>> layers;  ///< [image][level], level k has side >> k pixels, down to 1
};

/// Mip levels of a square image with a power-of-two side, level 0 first. Colours are averaged in linear light and
/// weighted by alpha, so that the colours of transparent texels do not bleed in.
/// @param alphaCutoff  if given, every level keeps the share of texels whose alpha reaches the cutoff; plain averages
/// would make distant leaves vanish
std::vector<ImageRgba8> makeMipLevels(const ImageRgba8& image, std::optional<float> alphaCutoff);

/// Share of texels with alpha >= cutoff.
float alphaCoverage(const ImageRgba8& image, float cutoff);

/// Resamples every image to the smallest power of two that holds the largest one, at most maxSide.
/// @param alphaCutoffs  per image, for makeMipLevels; may be shorter than images
TextureLayers makeTextureLayers(const std::vector<ImageRgba8>& images,
                                const std::vector<std::optional<float>>& alphaCutoffs = {},
                                std::uint32_t maxSide = 1024);

}  // namespace jalousie::scene
