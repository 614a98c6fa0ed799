// Base colour textures as equal layers of one array, so that one draw call can use them all.
#pragma once

#include <cstdint>
#include <vector>

#include "asset/scene_file.h"
#include "core/image.h"

namespace jalousie::scene {

/// Square layers of one size, in the order of the file's images.
struct TextureLayers {
  std::uint32_t side = 1;  ///< pixels, a power of two
  std::vector<ImageRgba8> layers;
};

/// Resamples every image to the smallest power of two that holds the largest one, at most maxSide.
TextureLayers makeTextureLayers(const std::vector<ImageRgba8>& images, std::uint32_t maxSide = 1024);

}  // namespace jalousie::scene
