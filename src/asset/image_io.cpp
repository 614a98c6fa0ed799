// PNG and JPEG through stb, which sees a file only after its first bytes and its size have been checked here.
#include "asset/image_io.h"

#include <fmt/format.h>
#include <stb_image.h>
#include <stb_image_resize.h>
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "core/check.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::asset {
namespace {

constexpr std::array<unsigned char, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::array<unsigned char, 3> kJpegSignature = {0xFF, 0xD8, 0xFF};

/// Bytes of the largest PNG or JPEG file read; far above what any allowed size compresses to.
constexpr std::uint64_t kMaxImageFileBytes = 1ULL << 30U;

template <std::size_t N>
bool startsWith(std::span<const std::byte> bytes, const std::array<unsigned char, N>& signature) {
  return bytes.size() >= N && std::memcmp(bytes.data(), signature.data(), N) == 0;
}

struct StbFree {
  void operator()(unsigned char* pixels) const { stbi_image_free(pixels); }
};

void appendBytes(void* context, void* data, int size) {
  auto& out = *static_cast<std::vector<std::byte>*>(context);
  const auto* first = static_cast<const std::byte*>(data);
  out.insert(out.end(), first, first + size);
}

bool opaque(const ImageRgba8& image) {
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
    if (image.pixels[i] != 255) return false;
  }
  return true;
}

std::vector<std::uint8_t> withoutAlpha(const ImageRgba8& image) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.pixels.size() / 4 * 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    rgb.push_back(image.pixels[i]);
    rgb.push_back(image.pixels[i + 1]);
    rgb.push_back(image.pixels[i + 2]);
  }
  return rgb;
}

void checkSize(const ImageRgba8& image) {
  JAL_CHECK(image.width > 0U);
  JAL_CHECK(image.height > 0U);
  JAL_CHECK(image.pixels.size() == static_cast<std::size_t>(image.width) * image.height * 4);
}

std::uint32_t bigEndian(const unsigned char* bytes) {
  return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U | std::uint32_t{bytes[2]} << 8U |
         std::uint32_t{bytes[3]};
}

void requireSize(std::uint32_t width, std::uint32_t height, const ImageLimits& limits,
                 const std::filesystem::path& source) {
  if (width > limits.maxSide || height > limits.maxSide)
    throw Error(ErrorCode::kLimit,
                fmt::format("the picture has {} x {} pixels, the limit is {} a side", width, height, limits.maxSide),
                source);
  if (std::uint64_t{width} * height > limits.maxPixels)
    throw Error(ErrorCode::kLimit,
                fmt::format("the picture has {} x {} pixels, the limit is {} in all", width, height, limits.maxPixels),
                source);
}

}  // namespace

ImageSize imageSize(std::span<const std::byte> encoded, const ImageLimits& limits,
                    const std::filesystem::path& source) {
  if (!startsWith(encoded, kPngSignature) && !startsWith(encoded, kJpegSignature))
    throw Error(ErrorCode::kUnsupported, "image is neither PNG nor JPEG", source);
  if (encoded.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(ErrorCode::kLimit, "image file is too large", source);
  const auto* bytes = reinterpret_cast<const stbi_uc*>(encoded.data());
  // stb cannot say why it refuses the largest ones.
  if (startsWith(encoded, kPngSignature) && encoded.size() >= 24 && std::memcmp(bytes + 12, "IHDR", 4) == 0)
    requireSize(bigEndian(bytes + 16), bigEndian(bytes + 20), limits, source);
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(bytes, static_cast<int>(encoded.size()), &width, &height, &channels) == 0 || width <= 0 ||
      height <= 0)
    throw Error(ErrorCode::kMalformed, "image header cannot be read", source);
  requireSize(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), limits, source);
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

ImageRgba8 decodeImage(std::span<const std::byte> encoded, const ImageLimits& limits,
                       const std::filesystem::path& source) {
  imageSize(encoded, limits, source);
  const auto* bytes = reinterpret_cast<const stbi_uc*>(encoded.data());
  int width = 0;
  int height = 0;
  int channels = 0;
  const std::unique_ptr<unsigned char, StbFree> pixels(
      stbi_load_from_memory(bytes, static_cast<int>(encoded.size()), &width, &height, &channels, 4));
  if (pixels == nullptr) throw Error(ErrorCode::kMalformed, "image cannot be decoded", source);
  ImageRgba8 image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  image.pixels.assign(pixels.get(),
                      pixels.get() + static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  return image;
}

std::vector<std::byte> encodePng(const ImageRgba8& image) {
  checkSize(image);
  const int width = static_cast<int>(image.width);
  const int height = static_cast<int>(image.height);
  std::vector<std::byte> bytes;
  int ok = 0;
  if (opaque(image)) {
    const std::vector<std::uint8_t> rgb = withoutAlpha(image);
    ok = stbi_write_png_to_func(appendBytes, &bytes, width, height, 3, rgb.data(), width * 3);
  } else {
    ok = stbi_write_png_to_func(appendBytes, &bytes, width, height, 4, image.pixels.data(), width * 4);
  }
  if (ok == 0) throw Error(ErrorCode::kWriteFailed, "PNG encoding failed");
  return bytes;
}

void savePng(const ImageRgba8& image, const std::filesystem::path& path) {
  writeFileAtomic(path, encodePng(image));
}

ImageRgba8 loadImage(const std::filesystem::path& path, const ImageLimits& limits) {
  return decodeImage(readFile(path, kMaxImageFileBytes), limits, path);
}

ImageRgba8 resizeImage(const ImageRgba8& image, std::uint32_t width, std::uint32_t height) {
  checkSize(image);
  JAL_CHECK(width > 0U);
  JAL_CHECK(height > 0U);
  ImageRgba8 result{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height * 4)};
  const int ok = stbir_resize_uint8_srgb_edgemode(
      image.pixels.data(), static_cast<int>(image.width), static_cast<int>(image.height), 0, result.pixels.data(),
      static_cast<int>(width), static_cast<int>(height), 0, 4, 3, 0, STBIR_EDGE_WRAP);
  if (ok == 0) throw Error(ErrorCode::kLimit, fmt::format("cannot resample to {} x {}", width, height));
  return result;
}

}  // namespace jalousie::asset
