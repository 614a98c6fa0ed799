// PNG from its parts with zlib, JPEG with libjpeg-turbo, WebP with libwebp.
#include "support/picture_writer.h"

#include <webp/encode.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>  // jpeglib.h needs it
#include <cstdlib>
#include <memory>

#include <jpeglib.h>

#include "core/check.h"

namespace jalousie::test {
namespace {

std::string bigEndian(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8)
    text += static_cast<char>(value >> shift & 255U);
  return text;
}

const Bytef* zlibBytes(std::string_view text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

std::string compressed(const std::string& data) {
  uLongf size = compressBound(data.size());
  std::string out(size, '\0');
  JAL_CHECK(compress2(reinterpret_cast<Bytef*>(out.data()), &size, zlibBytes(data), data.size(), 9) == Z_OK);
  out.resize(size);
  return out;
}

/// Every stepX-th pixel from firstX on, of every stepY-th row; the whole picture or a pass of an interlaced one.
struct Pass {
  std::uint32_t firstX, firstY, stepX, stepY;
};
constexpr std::array<Pass, 7> kPasses = {
    {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};

void appendRow(std::string& out, const PngSpec& spec, const Pass& pass, std::uint32_t y) {
  std::uint32_t bits = 0;
  unsigned held = 0;
  out += '\0';  // no filter
  for (std::uint32_t x = pass.firstX; x < spec.width; x += pass.stepX) {
    for (unsigned channel = 0; channel < pngChannels(spec); ++channel) {
      bits = bits << spec.depth | pngSample(spec, x, y, channel);
      for (held += spec.depth; held >= 8; held -= 8)
        out += static_cast<char>(bits >> (held - 8) & 255U);
    }
  }
  if (held > 0) out += static_cast<char>(bits << (8 - held) & 255U);
}

std::string pngRows(const PngSpec& spec) {
  std::string rows;
  const auto append = [&](const Pass& pass) {
    if (pass.firstX >= spec.width) return;
    for (std::uint32_t y = pass.firstY; y < spec.height; y += pass.stepY)
      appendRow(rows, spec, pass, y);
  };
  if (spec.interlaced)
    std::for_each(kPasses.begin(), kPasses.end(), append);
  else
    append({0, 0, 1, 1});
  return rows;
}

std::string riffChunk(std::string_view type, const std::string& data) {
  std::string size = bigEndian(static_cast<std::uint32_t>(data.size()));
  std::reverse(size.begin(), size.end());
  return std::string(type) + size + data + std::string(data.size() % 2, '\0');
}

}  // namespace

std::string pngChunk(std::string_view type, std::string_view data) {
  const std::string body = std::string(type) + std::string(data);
  return bigEndian(static_cast<std::uint32_t>(data.size())) + body +
         bigEndian(static_cast<std::uint32_t>(crc32(0, zlibBytes(body), static_cast<uInt>(body.size()))));
}

unsigned pngChannels(const PngSpec& spec) {
  constexpr std::array<unsigned, 7> kChannels = {1, 0, 3, 1, 2, 0, 4};
  return kChannels.at(spec.colourType);
}

std::uint32_t pngSample(const PngSpec& spec, std::uint32_t x, std::uint32_t y, unsigned channel) {
  std::uint32_t hash = x * 0x9E3779B1U ^ (y + 1) * 0x85EBCA77U ^ (channel + 1) * 0xC2B2AE3DU;
  hash = (hash ^ hash >> 15U) * 0x27D4EB2FU;
  return (hash ^ hash >> 13U) & ((1U << spec.depth) - 1U);
}

std::string pngHeader(const PngSpec& spec) {
  std::string data = bigEndian(spec.width) + bigEndian(spec.height);
  for (const unsigned value : {spec.depth, spec.colourType, 0U, 0U, spec.interlaced ? 1U : 0U})
    data += static_cast<char>(value);
  return std::string(kPngSignature) + pngChunk("IHDR", data);
}

std::string pngFile(const PngSpec& spec) {
  return pngHeader(spec) + spec.before + pngChunk("IDAT", compressed(pngRows(spec))) + pngChunk("IEND", "");
}

std::string zlibZeros(std::uint32_t mebibytes) {
  // One flushed block, over and over: zlib itself would take seconds for a gibibyte.
  const std::string zeros(1U << 20U, '\0');
  std::string block(4096, '\0');
  z_stream stream = {};
  JAL_CHECK(deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY) == Z_OK);
  stream.next_in = const_cast<Bytef*>(zlibBytes(zeros));
  stream.avail_in = static_cast<uInt>(zeros.size());
  stream.next_out = reinterpret_cast<Bytef*>(block.data());
  stream.avail_out = static_cast<uInt>(block.size());
  JAL_CHECK(deflate(&stream, Z_FULL_FLUSH) == Z_OK);
  block.resize(stream.total_out);
  deflateEnd(&stream);
  std::string out = "\x78\x9C";
  for (std::uint32_t i = 0; i < mebibytes; ++i)
    out += block;
  out += std::string("\x03\x00", 2);
  const std::uint64_t count = std::uint64_t{mebibytes} << 20U;
  return out + bigEndian(static_cast<std::uint32_t>(count % 65521U) << 16U | 1U);
}

std::uint8_t jpegSample(std::uint32_t x, std::uint32_t y, unsigned channel) {
  const std::array<std::uint32_t, 4> values = {40 + 4 * x, 200 - 3 * y, 60 + x + 2 * y, 20 + 2 * x};
  return static_cast<std::uint8_t>(std::min(values.at(channel), 255U));
}

std::string jpegFile(const JpegSpec& spec) {
  constexpr std::array<J_COLOR_SPACE, 5> kIn = {JCS_GRAYSCALE, JCS_RGB, JCS_RGB, JCS_CMYK, JCS_CMYK};
  constexpr std::array<J_COLOR_SPACE, 5> kStored = {JCS_GRAYSCALE, JCS_YCbCr, JCS_RGB, JCS_CMYK, JCS_YCCK};
  constexpr std::array<int, 5> kChannels = {1, 3, 3, 4, 4};
  const auto index = static_cast<std::size_t>(spec.colours);
  jpeg_compress_struct info;
  jpeg_error_mgr errors;
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &bytes, &size);
  info.image_width = spec.width;
  info.image_height = spec.height;
  info.input_components = kChannels.at(index);
  info.in_color_space = kIn.at(index);
  jpeg_set_defaults(&info);
  jpeg_set_colorspace(&info, kStored.at(index));
  jpeg_set_quality(&info, 95, TRUE);
  if (!spec.adobe) info.write_Adobe_marker = FALSE;
  if (spec.progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  const auto channels = static_cast<unsigned>(info.input_components);
  std::vector<std::uint8_t> samples(std::size_t{channels} * spec.width);
  for (std::uint32_t y = 0; y < spec.height; ++y) {
    for (std::uint32_t x = 0; x < spec.width; ++x)
      for (unsigned c = 0; c < channels; ++c)
        samples[std::size_t{channels} * x + c] = jpegSample(x, y, c);
    JSAMPROW row = samples.data();
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  std::string file(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  return file;
}

std::vector<std::size_t> jpegMarkers(std::string_view file) {
  std::vector<std::size_t> markers;
  const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(file[at]); };
  std::size_t at = 0;
  while (at + 1 < file.size()) {
    const bool isMarker = byte(at) == 0xFF && byte(at + 1) != 0 && byte(at + 1) != 0xFF;
    if (!isMarker) {
      ++at;
      continue;
    }
    markers.push_back(at);
    const bool hasLength = byte(at + 1) != 0xD8 && byte(at + 1) != 0xD9 && (byte(at + 1) & 0xF8U) != 0xD0;
    at += hasLength ? 2U + byte(at + 2) * 256U + byte(at + 3) : 2U;
  }
  return markers;
}

std::string webpFile(const ImageRgba8& image, bool lossless) {
  std::uint8_t* bytes = nullptr;
  const int width = static_cast<int>(image.width);
  const int height = static_cast<int>(image.height);
  const std::size_t size = lossless ? WebPEncodeLosslessRGBA(image.pixels.data(), width, height, 4 * width, &bytes)
                                    : WebPEncodeRGBA(image.pixels.data(), width, height, 4 * width, 90.0F, &bytes);
  const std::unique_ptr<std::uint8_t, void (*)(void*)> owner(bytes, WebPFree);
  JAL_CHECK(size > 0U);
  return {reinterpret_cast<const char*>(bytes), size};
}

std::string webpAnimation() {
  const std::string still = webpFile(noisePicture(8, 8), true);
  const std::string frame = riffChunk("ANMF", std::string("\0\0\0\0\0\0\7\0\0\7\0\0\144\0\0\0", 16) + still.substr(12));
  const std::string body = "WEBP" + riffChunk("VP8X", std::string("\2\0\0\0\7\0\0\7\0\0", 10)) +
                           riffChunk("ANIM", std::string(6, '\0')) + frame + frame;
  return riffChunk("RIFF", body);
}

ImageRgba8 noisePicture(std::uint32_t width, std::uint32_t height) {
  ImageRgba8 image{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      for (unsigned c = 0; c < 4; ++c)
        image.pixels.push_back(static_cast<std::uint8_t>(pngSample({}, x, y, c)));
  return image;
}

}  // namespace jalousie::test
