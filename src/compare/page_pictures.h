// Encodes pictures for a page: WebP as data URIs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"

namespace jalousie::compare {

/// Size and quality of the encoded pictures.
struct PictureFormat {
  double scale = 1.0;     ///< of both sides, in (0, 1]
  float quality = 90.0F;  ///< of WebP, 0 to 100
};

/// Longest side that WebP can store, pixels.
inline constexpr long kMostWebpSide = 16383;

/// From best quality to smallest size.
std::span<const PictureFormat> pictureFormats();

/// Encodes R, G and B; alpha is left out. Errors: kLimit if the encoder fails.
std::vector<std::uint8_t> encodeWebp(const ImageRgba8& image, const PictureFormat& format);

/// "data:image/webp;base64," and the bytes in base64 (RFC 4648).
std::string dataUri(std::span<const std::uint8_t> webp);

}  // namespace jalousie::compare
