// Reading of PNG, JPEG and WebP within limits, writing of PNG, resampling.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "asset/read_limits.h"
#include "core/image.h"

namespace jalousie::asset {

/// Width and height in pixels, both > 0.
struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// "image/png", "image/jpeg", "image/webp", or empty for anything else, by the first bytes.
std::string_view imageMimeType(std::span<const std::byte> encoded);

/// Reads the header of an encoded picture; decodes nothing. @param source  names the picture in errors
/// Errors: kMalformed, kUnsupported (another format), kLimit.
ImageSize imageSize(std::span<const std::byte> encoded, const ImageLimits& limits = {},
                    const std::filesystem::path& source = {});

/// Decodes a picture to RGBA8. 16-bit channels lose their low byte; gamma and colour profiles are ignored; a CMYK
/// picture is converted without a profile. @param source  names the picture in errors
/// Errors: kMalformed (broken or cut off, with the library's reason), kUnsupported (another format, an animation, a
/// JPEG that is lossless, arithmetic-coded or not of 8 bits), kLimit (checked before decoding).
ImageRgba8 decodeImage(std::span<const std::byte> encoded, const ImageLimits& limits = {},
                       const std::filesystem::path& source = {});

/// Decodes a picture and keeps nothing; PNG and JPEG take the memory of a few rows (a progressive JPEG that of its
/// coefficients). Errors: as decodeImage.
void checkImage(std::span<const std::byte> encoded, const ImageLimits& limits = {},
                const std::filesystem::path& source = {});

/// Encodes as PNG (RGB if every alpha is 255, else RGBA). Deterministic. Errors: kWriteFailed (out of memory).
std::vector<std::byte> encodePng(const ImageRgba8& image);
/// encodePng and core's writeFileAtomic. Errors: kWriteFailed.
void savePng(const ImageRgba8& image, const std::filesystem::path& path);
/// readFile and imageSize.
ImageSize imageFileSize(const std::filesystem::path& path, const ImageLimits& limits = {});
/// readFile and decodeImage.
ImageRgba8 loadImage(const std::filesystem::path& path, const ImageLimits& limits = {});

/// What lies beyond the edge of a picture: its other side, or more of its edge.
enum class ImageEdge { kWrap, kClamp };

/// Resamples to width x height, both > 0: colour channels in sRGB, weighted by alpha; alpha linear.
ImageRgba8 resizeImage(const ImageRgba8& image, std::uint32_t width, std::uint32_t height,
                       ImageEdge edge = ImageEdge::kWrap);

}  // namespace jalousie::asset
