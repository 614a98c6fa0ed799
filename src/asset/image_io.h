// PNG and JPEG decoding with a pixel cap, PNG encoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "asset/read_limits.h"
#include "core/image.h"

namespace jalousie::asset {

/// Width and height in pixels, both > 0.
struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// Reads the header of an encoded picture; decodes nothing. @param source  names the picture in errors
/// Errors: kMalformed, kUnsupported (another format), kLimit.
ImageSize imageSize(std::span<const std::byte> encoded, const ImageLimits& limits = {},
                    const std::filesystem::path& source = {});

/// Decodes a picture to RGBA8. @param source  names the picture in errors
/// Errors: kMalformed, kUnsupported (another format), kLimit (checked before decoding).
ImageRgba8 decodeImage(std::span<const std::byte> encoded, const ImageLimits& limits = {},
                       const std::filesystem::path& source = {});

/// Encodes as PNG (RGB if every alpha is 255, else RGBA). Deterministic.
std::vector<std::byte> encodePng(const ImageRgba8& image);
/// encodePng and core's writeFileAtomic. Errors: kWriteFailed.
void savePng(const ImageRgba8& image, const std::filesystem::path& path);
/// readFile and decodeImage.
ImageRgba8 loadImage(const std::filesystem::path& path, const ImageLimits& limits = {});

/// Resamples to width x height (colour channels in sRGB, alpha linear, edges wrap), both > 0.
ImageRgba8 resizeImage(const ImageRgba8& image, std::uint32_t width, std::uint32_t height);

}  // namespace jalousie::asset
