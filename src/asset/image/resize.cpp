// Resampling through stb_image_resize, which parses nothing.
#include <fmt/format.h>
#include <stb_image_resize.h>

#include "asset/image_io.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset {

ImageRgba8 resizeImage(const ImageRgba8& image, std::uint32_t width, std::uint32_t height, ImageEdge edge) {
  JAL_CHECK(image.width > 0U);
  JAL_CHECK(image.height > 0U);
  JAL_CHECK(image.pixels.size() == static_cast<std::size_t>(image.width) * image.height * 4);
  JAL_CHECK(width > 0U);
  JAL_CHECK(height > 0U);
  ImageRgba8 result{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height * 4)};
  const int ok = stbir_resize_uint8_srgb_edgemode(image.pixels.data(), static_cast<int>(image.width),
                                                  static_cast<int>(image.height), 0, result.pixels.data(),
                                                  static_cast<int>(width), static_cast<int>(height), 0, 4, 3, 0,
                                                  edge == ImageEdge::kWrap ? STBIR_EDGE_WRAP : STBIR_EDGE_CLAMP);
  if (ok == 0) throw Error(ErrorCode::kLimit, fmt::format("cannot resample to {} x {}", width, height));
  return result;
}

}  // namespace jalousie::asset
