// PNG through libpng: all types and depths, interlaced or not. Of the chunks that a decoder may ignore, only tRNS is
// read, so that no text or profile is unpacked.
#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "asset/image/codecs.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

/// Bytes of image data behind the last row that are unpacked and dropped, each up to 1032 bytes; encoders write a few.
constexpr std::size_t kMaxSurplusBytes = 64U << 10U;

/// libpng reports an error by a function that must not return. This struct is plain, and so is every function between
/// setjmp and longjmp.
struct Decoder {
  png_structp png;
  png_infop info;
  const std::byte* next;
  std::size_t left;
  std::jmp_buf failed;
  char reason[160];
  std::uint8_t* row;
  int passes;
  std::size_t imageDataLeft;  ///< bytes of IDAT chunks that may still be read
};

[[noreturn]] void onError(png_structp png, png_const_charp reason) {
  auto& decoder = *static_cast<Decoder*>(png_get_error_ptr(png));
  std::snprintf(decoder.reason, sizeof decoder.reason, "%s", reason);
  std::longjmp(decoder.failed, 1);
}

/// Whether pixels are missing or wrong after a warning, which begins with the name of a chunk.
bool losesPixels(std::string_view warning) {
  if (!warning.starts_with("IDAT: ") && !warning.starts_with("PLTE: ") && !warning.starts_with("tRNS: ")) return false;
  for (const std::string_view harmless : {"Extra compressed data", "Too much image data", "Too many IDATs found",
                                          "ignored in grayscale PNG", "invalid with alpha channel"})
    if (warning.ends_with(harmless)) return false;
  return true;
}

void onWarning(png_structp png, png_const_charp warning) {
  if (losesPixels(warning)) onError(png, warning);
}

void takeBytes(png_structp png, png_bytep out, std::size_t count) {
  auto& decoder = *static_cast<Decoder*>(png_get_io_ptr(png));
  if (count > decoder.left) onError(png, "the file is cut off");
  constexpr png_uint_32 kIdat = 0x49444154;
  if (png_get_io_chunk_type(png) == kIdat) {
    if (count > decoder.imageDataLeft) onError(png, "IDAT: far too much image data");
    decoder.imageDataLeft -= count;
  }
  std::memcpy(out, decoder.next, count);
  decoder.next += count;
  decoder.left -= count;
}

/// Runs a step. @return  false if it failed; the decoder then has a reason
bool attempt(Decoder& decoder, void (*step)(Decoder&)) {
  if (setjmp(decoder.failed) != 0) return false;
  step(decoder);
  return true;
}

void create(Decoder& decoder) {
  decoder.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoder, onError, onWarning);
  if (decoder.png != nullptr) decoder.info = png_create_info_struct(decoder.png);
  if (decoder.info == nullptr) {
    std::snprintf(decoder.reason, sizeof decoder.reason, "libpng cannot start");
    std::longjmp(decoder.failed, 1);
  }
}

void readHeader(Decoder& decoder) {
  png_set_read_fn(decoder.png, &decoder, takeBytes);
  png_set_user_limits(decoder.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // ours come next
  png_set_keep_unknown_chunks(decoder.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(decoder.png, decoder.info);
}

void start(Decoder& decoder) {
  png_set_expand(decoder.png);
  png_set_strip_16(decoder.png);
  png_set_gray_to_rgb(decoder.png);
  png_set_add_alpha(decoder.png, 255, PNG_FILLER_AFTER);
  decoder.passes = png_set_interlace_handling(decoder.png);
  png_read_update_info(decoder.png, decoder.info);
}

void readRow(Decoder& decoder) {
  png_read_row(decoder.png, decoder.row, nullptr);
}

void finish(Decoder& decoder) {
  png_read_end(decoder.png, nullptr);
}

/// Owns a decoder, and turns failed steps into Error.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> encoded) {
    decoder_.next = encoded.data();
    decoder_.left = encoded.size();
    decoder_.imageDataLeft = encoded.size();
  }
  ~Reader() { png_destroy_read_struct(&decoder_.png, &decoder_.info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void run(void (*step)(Decoder&)) {
    if (!attempt(decoder_, step))
      throw Error(ErrorCode::kMalformed, fmt::format("the PNG is broken: {}", decoder_.reason));
  }
  void readRowTo(std::uint8_t* row) {
    decoder_.row = row;
    run(readRow);
  }
  /// Called before the last rows, in which libpng reads what is left of the image data. @param width  in pixels
  void expectEnd(std::uint32_t width) { decoder_.imageDataLeft = std::size_t{16} * width + kMaxSurplusBytes; }
  const Decoder& decoder() const { return decoder_; }

 private:
  Decoder decoder_ = {};
};

/// deflate packs at most 1032 bytes into one.
std::uint64_t leastBytes(const Decoder& decoder, const ImageSize& size) {
  const std::uint64_t bits = std::uint64_t{png_get_channels(decoder.png, decoder.info)} *
                             png_get_bit_depth(decoder.png, decoder.info) * size.width;
  return bits / 8 * size.height / 1032;
}

}  // namespace

ImageSize readPng(std::span<const std::byte> encoded, const ImageLimits& limits, RowSink* sink) {
  Reader reader(encoded);
  reader.run(create);
  reader.run(readHeader);
  const Decoder& decoder = reader.decoder();
  const ImageSize size{png_get_image_width(decoder.png, decoder.info), png_get_image_height(decoder.png, decoder.info)};
  requireSize(size, limits);
  requireBytes(encoded.size(), leastBytes(decoder, size), size);
  if (sink == nullptr) return size;

  reader.run(start);
  JAL_CHECK(png_get_rowbytes(decoder.png, decoder.info) == std::size_t{4} * size.width);
  sink->begin(size);
  for (int pass = 0; pass < decoder.passes; ++pass) {
    for (std::uint32_t y = 0; y < size.height; ++y) {
      // Of an interlaced picture, the last row may not be part of the last pass.
      const bool isLastPass = pass + 1 == decoder.passes || size.height == 1;
      if (isLastPass && y + 2 >= size.height) reader.expectEnd(size.width);
      reader.readRowTo(sink->row(y));
    }
  }
  reader.run(finish);
  return size;
}

}  // namespace jalousie::asset::detail
