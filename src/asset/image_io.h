// PNG and JPEG decoding with a pixel cap, PNG encoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/image.h"

namespace jalousie::asset {

/// Reads the header of a PNG or JPEG. Errors: as decodeImage, which checks no more before it decodes.
void checkImageHeader(std::span<const std::byte> encoded, std::uint32_t maxSide,
                      const std::filesystem::path& source = {});

/// Decodes a PNG or JPEG to RGBA8; nothing else is accepted. @param source  names the image in errors.
/// Errors: kMalformed, kUnsupported (another format), kLimit (a side above maxSide; checked before decoding).
ImageRgba8 decodeImage(std::span<const std::byte> encoded, std::uint32_t maxSide,
                       const std::filesystem::path& source = {});

/// Encodes as PNG (RGB if every alpha is 255, else RGBA). Deterministic.
std::vector<std::byte> encodePng(const ImageRgba8& image);
/// encodePng and core's writeFileAtomic. Errors: kWriteFailed.
void savePng(const ImageRgba8& image, const std::filesystem::path& path);
/// readFile and decodeImage.
ImageRgba8 loadImage(const std::filesystem::path& path, std::uint32_t maxSide = 16384);

/// Resamples to width x height (colour channels in sRGB, alpha linear, edges wrap), both > 0.
ImageRgba8 resizeImage(const ImageRgba8& image, std::uint32_t width, std::uint32_t height);

}  // namespace jalousie::asset
