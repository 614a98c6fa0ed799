// JPEG through libjpeg-turbo: grey, YCbCr, RGB, CMYK and YCCK, sequential and progressive, 8 bits, Huffman codes.
#include <fmt/format.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it
// This one comes after stdio.
#include <jerror.h>
#include <jpeglib.h>

#include "asset/image/codecs.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

/// Scans of a progressive picture. Encoders write about ten; each one costs a pass over all blocks.
constexpr int kMaxScans = 100;

/// libjpeg reports an error by a function that must not return. This struct is plain, and so is every function between
/// setjmp and longjmp.
struct Decoder {
  jpeg_decompress_struct info;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  std::jmp_buf failed;
  ErrorCode code;
  char reason[JMSG_LENGTH_MAX];
  std::uint8_t* row;
};

bool isLimit(int message) {
  return message == JERR_NO_BACKING_STORE || message == JERR_OUT_OF_MEMORY || message == JERR_IMAGE_TOO_BIG ||
         message == JERR_WIDTH_OVERFLOW;
}

bool isUnsupported(int message) {
  return message == JERR_SOF_UNSUPPORTED || message == JERR_BAD_PRECISION || message == JERR_ARITH_NOTIMPL ||
         message == JERR_NOT_COMPILED || message == JERR_CONVERSION_NOTIMPL || message == JERR_CCIR601_NOTIMPL ||
         message == JERR_FRACT_SAMPLE_NOTIMPL;
}

/// Whether pixels are missing or wrong after a warning.
bool losesPixels(int message) {
  return message == JWRN_JPEG_EOF || message == JWRN_HIT_MARKER || message == JWRN_HUFF_BAD_CODE ||
         message == JWRN_MUST_RESYNC;
}

[[noreturn]] void onError(j_common_ptr info) {
  auto& decoder = *static_cast<Decoder*>(info->client_data);
  const int message = info->err->msg_code;
  decoder.code = isLimit(message)         ? ErrorCode::kLimit
                 : isUnsupported(message) ? ErrorCode::kUnsupported
                                          : ErrorCode::kMalformed;
  info->err->format_message(info, decoder.reason);
  std::longjmp(decoder.failed, 1);
}

void onMessage(j_common_ptr info, int level) {
  if (level < 0 && losesPixels(info->err->msg_code)) onError(info);
}

[[noreturn]] void refuse(Decoder& decoder, ErrorCode code, const char* reason) {
  decoder.code = code;
  std::snprintf(decoder.reason, sizeof decoder.reason, "%s", reason);
  std::longjmp(decoder.failed, 1);
}

void onProgress(j_common_ptr info) {
  auto& decoder = *static_cast<Decoder*>(info->client_data);
  if (decoder.info.input_scan_number > kMaxScans) refuse(decoder, ErrorCode::kLimit, "more than 100 scans");
}

/// Runs a step. @return  false if it failed; the decoder then has code and reason
bool attempt(Decoder& decoder, void (*step)(Decoder&)) {
  if (setjmp(decoder.failed) != 0) return false;
  step(decoder);
  return true;
}

void create(Decoder& decoder) {
  jpeg_create_decompress(&decoder.info);
}

void readHeader(Decoder& decoder) {
  jpeg_read_header(&decoder.info, TRUE);
  if (decoder.info.arith_code) refuse(decoder, ErrorCode::kUnsupported, "arithmetic codes");
}

void start(Decoder& decoder) {
  jpeg_start_decompress(&decoder.info);
}

void readRow(Decoder& decoder) {
  JSAMPROW row = decoder.row;
  jpeg_read_scanlines(&decoder.info, &row, 1);
}

void finish(Decoder& decoder) {
  jpeg_finish_decompress(&decoder.info);
}

/// Owns a decoder, and turns failed steps into Error.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> encoded) {
    decoder_.info.err = jpeg_std_error(&decoder_.errors);
    decoder_.errors.error_exit = onError;
    decoder_.errors.emit_message = onMessage;
    decoder_.info.client_data = &decoder_;
    run(create);
    decoder_.progress.progress_monitor = onProgress;
    decoder_.info.progress = &decoder_.progress;
    jpeg_mem_src(&decoder_.info, reinterpret_cast<const unsigned char*>(encoded.data()), encoded.size());
  }
  ~Reader() { jpeg_destroy_decompress(&decoder_.info); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void run(void (*step)(Decoder&)) {
    if (attempt(decoder_, step)) return;
    throw Error(decoder_.code, fmt::format("the JPEG {}: {}",
                                           decoder_.code == ErrorCode::kUnsupported ? "is of a kind that is not read"
                                           : decoder_.code == ErrorCode::kLimit     ? "exceeds a limit"
                                                                                    : "is broken",
                                           decoder_.reason));
  }
  void readRowTo(std::uint8_t* row) {
    decoder_.row = row;
    run(readRow);
  }
  jpeg_decompress_struct& info() { return decoder_.info; }

 private:
  Decoder decoder_ = {};
};

/// A block takes at least one bit of Huffman codes.
std::uint64_t leastBytes(const jpeg_decompress_struct& info) {
  std::uint64_t blocks = 0;
  for (int i = 0; i < info.num_components; ++i)
    blocks += std::uint64_t{info.comp_info[i].width_in_blocks} * info.comp_info[i].height_in_blocks;
  return blocks / 8;
}

std::uint8_t product(unsigned a, unsigned b) {
  return static_cast<std::uint8_t>((a * b + 127) / 255);
}

/// Adobe's programs, which say so in a marker, store 255 for no ink; others store 0.
void rgbaFromCmyk(std::uint8_t* pixels, std::uint32_t width, bool inverted) {
  const unsigned flip = inverted ? 0U : 255U;
  for (std::uint8_t* pixel = pixels; pixel != pixels + std::size_t{4} * width; pixel += 4) {
    const unsigned light = pixel[3] ^ flip;
    for (int c = 0; c < 3; ++c)
      pixel[c] = product(pixel[c] ^ flip, light);
    pixel[3] = 255;
  }
}

}  // namespace

ImageSize readJpeg(std::span<const std::byte> encoded, const ImageLimits& limits, RowSink* sink) {
  Reader reader(encoded);
  jpeg_decompress_struct& info = reader.info();
  reader.run(readHeader);
  const ImageSize size{info.image_width, info.image_height};
  requireSize(size, limits);
  requireBytes(encoded.size(), leastBytes(info), size);
  if (sink == nullptr) return size;

  // Coefficients of a progressive picture take 2 bytes for each of at most 4 components.
  constexpr std::uint64_t kOtherBytes = 16U << 20U;
  info.mem->max_memory_to_use =
      static_cast<long>(std::min<std::uint64_t>(8 * limits.maxPixels + kOtherBytes, 1ULL << 40U));
  const bool isCmyk = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
  info.out_color_space = isCmyk ? JCS_CMYK : JCS_EXT_RGBA;
  info.dct_method = JDCT_ISLOW;
  reader.run(start);
  sink->begin(size);
  for (std::uint32_t y = 0; y < size.height; ++y) {
    std::uint8_t* row = sink->row(y);
    reader.readRowTo(row);
    if (isCmyk) rgbaFromCmyk(row, size.width, info.saw_Adobe_marker != 0);
  }
  reader.run(finish);
  return size;
}

}  // namespace jalousie::asset::detail
