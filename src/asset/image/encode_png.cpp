// PNG encoding through libpng, with fixed settings: the same pixels give the same bytes.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <new>

#include "asset/image_io.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

constexpr int kCompression = 6;
constexpr int kFilters = PNG_ALL_FILTERS;

/// Plain, as is every function between setjmp and longjmp but those that libpng calls, which end first.
struct Encoder {
  png_structp png;
  png_infop info;
  std::vector<std::byte>* out;
  const ImageRgba8* image;
  bool hasAlpha;
  std::jmp_buf failed;
  char reason[160];
};

[[noreturn]] void onError(png_structp png, png_const_charp reason) {
  auto& encoder = *static_cast<Encoder*>(png_get_error_ptr(png));
  std::snprintf(encoder.reason, sizeof encoder.reason, "%s", reason);
  std::longjmp(encoder.failed, 1);
}

void onWarning(png_structp, png_const_charp) {}

/// No exception may pass through libpng. @return  false if memory is short
bool append(std::vector<std::byte>& out, const png_byte* bytes, std::size_t count) noexcept {
  try {
    const auto* first = reinterpret_cast<const std::byte*>(bytes);
    out.insert(out.end(), first, first + count);
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

void putBytes(png_structp png, png_bytep bytes, std::size_t count) {
  if (!append(*static_cast<Encoder*>(png_get_io_ptr(png))->out, bytes, count)) onError(png, "out of memory");
}

void flush(png_structp) {}

bool attempt(Encoder& encoder, void (*step)(Encoder&)) {
  if (setjmp(encoder.failed) != 0) return false;
  step(encoder);
  return true;
}

void encode(Encoder& encoder) {
  encoder.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoder, onError, onWarning);
  if (encoder.png != nullptr) encoder.info = png_create_info_struct(encoder.png);
  if (encoder.info == nullptr) {
    std::snprintf(encoder.reason, sizeof encoder.reason, "libpng cannot start");
    std::longjmp(encoder.failed, 1);
  }
  const ImageRgba8& image = *encoder.image;
  png_set_write_fn(encoder.png, &encoder, putBytes, flush);
  png_set_user_limits(encoder.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_compression_level(encoder.png, kCompression);
  png_set_filter(encoder.png, PNG_FILTER_TYPE_BASE, kFilters);
  png_set_IHDR(encoder.png, encoder.info, image.width, image.height, 8,
               encoder.hasAlpha ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  png_write_info(encoder.png, encoder.info);
  if (!encoder.hasAlpha) png_set_filler(encoder.png, 0, PNG_FILLER_AFTER);
  for (std::uint32_t y = 0; y < image.height; ++y)
    png_write_row(encoder.png, image.pixels.data() + image.offset(0, y));
  png_write_end(encoder.png, encoder.info);
}

bool opaque(const ImageRgba8& image) {
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
    if (image.pixels[i] != 255) return false;
  }
  return true;
}

}  // namespace

std::vector<std::byte> encodePng(const ImageRgba8& image) {
  JAL_CHECK(image.width > 0U);
  JAL_CHECK(image.height > 0U);
  JAL_CHECK(image.pixels.size() == static_cast<std::size_t>(image.width) * image.height * 4);
  std::vector<std::byte> bytes;
  Encoder encoder = {};
  encoder.out = &bytes;
  encoder.image = &image;
  encoder.hasAlpha = !opaque(image);
  const bool done = attempt(encoder, encode);
  png_destroy_write_struct(&encoder.png, &encoder.info);
  if (!done) throw Error(ErrorCode::kWriteFailed, fmt::format("PNG encoding failed: {}", encoder.reason));
  return bytes;
}

}  // namespace jalousie::asset
