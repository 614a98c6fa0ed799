// Layers of one size cost some memory and save every texture switch.
#include "scene/texture_layers.h"

#include <algorithm>
#include <bit>

#include "asset/image_io.h"

namespace jalousie::scene {

TextureLayers makeTextureLayers(const std::vector<ImageRgba8>& images, std::uint32_t maxSide) {
  TextureLayers result;
  for (const ImageRgba8& image : images)
    result.side = std::max({result.side, image.width, image.height});
  result.side = std::min(std::bit_ceil(result.side), std::bit_floor(maxSide));
  result.layers.reserve(images.size());
  for (const ImageRgba8& image : images) {
    const bool fits = image.width == result.side && image.height == result.side;
    result.layers.push_back(fits ? image : asset::resizeImage(image, result.side, result.side));
  }
  return result;
}

}  // namespace jalousie::scene
