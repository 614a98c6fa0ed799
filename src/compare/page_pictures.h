// Pictures small enough to travel inside a page.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"

namespace jalousie::compare {

/// How pictures are stored.
struct PictureFormat {
  double scale = 1.0;     ///< of both sides
  float quality = 90.0F;  ///< of WebP, 0 to 100
};

/// Longest side that WebP can store, pixels.
inline constexpr long kMostWebpSide = 16383;

/// From best to smallest.
std::span<const PictureFormat> pictureFormats();

/// Errors: kLimit where the encoder gives up.
std::vector<std::uint8_t> encodeWebp(const ImageRgba8& image, const PictureFormat& format);

/// "data:image/webp;base64,..."
std::string dataUri(std::span<const std::uint8_t> webp);

}  // namespace jalousie::compare
