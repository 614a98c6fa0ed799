// Encodes with libwebp.
#include "compare/page_pictures.h"

#include <webp/encode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "asset/image_io.h"
#include "core/error.h"

namespace jalousie::compare {
namespace {

constexpr std::array<PictureFormat, 9> kFormats = {{{1.0, 92.0F},
                                                    {1.0, 85.0F},
                                                    {1.0, 75.0F},
                                                    {0.75, 80.0F},
                                                    {0.75, 65.0F},
                                                    {0.5, 75.0F},
                                                    {0.5, 55.0F},
                                                    {0.35, 50.0F},
                                                    {0.2, 40.0F}}};

ImageRgba8 scaled(const ImageRgba8& image, double scale) {
  const auto side = [&](std::uint32_t length) {
    return static_cast<std::uint32_t>(std::max(std::lround(scale * length), 1L));
  };
  return asset::resizeImage(image, side(image.width), side(image.height), asset::ImageEdge::kClamp);
}

}  // namespace

std::span<const PictureFormat> pictureFormats() {
  return kFormats;
}

std::vector<std::uint8_t> encodeWebp(const ImageRgba8& image, const PictureFormat& format) {
  const ImageRgba8 smaller = format.scale < 1.0 ? scaled(image, format.scale) : ImageRgba8{};
  const ImageRgba8& source = format.scale < 1.0 ? smaller : image;
  std::vector<std::uint8_t> rgb;
  rgb.reserve(source.pixels.size() / 4 * 3);
  for (std::size_t i = 0; i < source.pixels.size(); ++i)
    if (i % 4 != 3) rgb.push_back(source.pixels[i]);
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeRGB(rgb.data(), static_cast<int>(source.width), static_cast<int>(source.height),
                                         static_cast<int>(3 * source.width), format.quality, &bytes);
  const std::unique_ptr<std::uint8_t, void (*)(void*)> owner(bytes, WebPFree);
  if (size == 0) throw Error(ErrorCode::kLimit, "a picture of the report cannot be encoded");
  return {bytes, bytes + size};
}

std::string dataUri(std::span<const std::uint8_t> webp) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = "data:image/webp;base64,";
  text.reserve(text.size() + (webp.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < webp.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(webp.size() - i, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8U | (k < count ? webp[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

}  // namespace jalousie::compare
