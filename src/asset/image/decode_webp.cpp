// WebP through libwebp: lossy and lossless still pictures.
#include <fmt/format.h>
#include <webp/decode.h>

#include "asset/image/codecs.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

void require(VP8StatusCode status) {
  switch (status) {
    case VP8_STATUS_OK:
      return;
    case VP8_STATUS_NOT_ENOUGH_DATA:
    case VP8_STATUS_SUSPENDED:
      throw Error(ErrorCode::kMalformed, "the WebP is broken: the file is cut off");
    case VP8_STATUS_OUT_OF_MEMORY:
      throw Error(ErrorCode::kLimit, "out of memory for a WebP");
    case VP8_STATUS_UNSUPPORTED_FEATURE:
      throw Error(ErrorCode::kUnsupported, "the WebP is of a kind that is not read");
    default:
      throw Error(ErrorCode::kMalformed, "the WebP is broken: its bit stream is not valid");
  }
}

}  // namespace

ImageSize readWebp(std::span<const std::byte> encoded, const ImageLimits& limits, RowSink* sink) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(encoded.data());
  WebPBitstreamFeatures features;
  require(WebPGetFeatures(bytes, encoded.size(), &features));
  const ImageSize size{static_cast<std::uint32_t>(features.width), static_cast<std::uint32_t>(features.height)};
  requireSize(size, limits);
  if (features.has_animation != 0) throw Error(ErrorCode::kUnsupported, "the WebP is an animation");
  if (sink == nullptr) return size;

  sink->begin(size);
  const int stride = 4 * features.width;
  const std::size_t total = static_cast<std::size_t>(stride) * size.height;
  std::uint8_t* const pixels = sink->row(size.height - 1) - static_cast<std::size_t>(stride) * (size.height - 1);
  WebPDecoderConfig config;
  if (WebPInitDecoderConfig(&config) == 0) throw Error(ErrorCode::kInternal, "libwebp has another version");
  config.output.colorspace = MODE_RGBA;
  config.output.is_external_memory = 1;
  config.output.u.RGBA = {pixels, stride, total};
  require(WebPDecode(bytes, encoded.size(), &config));
  return size;
}

}  // namespace jalousie::asset::detail
