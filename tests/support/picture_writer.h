// Writes small PNG, JPEG and WebP files of every kind, well-formed ones and, chunk by chunk, others.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace jalousie::test {

/// A chunk with length and checksum. @param type  four letters
std::string pngChunk(std::string_view type, std::string_view data);
inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1A\n";

struct PngSpec {
  std::uint32_t width = 13;
  std::uint32_t height = 11;
  unsigned depth = 8;       ///< bits of a sample
  unsigned colourType = 6;  ///< of the format: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
  bool interlaced = false;
  std::string before = {};  ///< chunks between IHDR and IDAT
};

unsigned pngChannels(const PngSpec& spec);
/// A sample that any value of the depth may be; the same for the same place.
std::uint32_t pngSample(const PngSpec& spec, std::uint32_t x, std::uint32_t y, unsigned channel);
std::string pngHeader(const PngSpec& spec);
/// The whole file, of pngSample.
std::string pngFile(const PngSpec& spec);
/// zlib's stream of so many zero bytes.
std::string zlibZeros(std::uint32_t mebibytes);

enum class JpegColours { kGrey, kYcc, kRgb, kCmyk, kYcck };
struct JpegSpec {
  std::uint32_t width = 40;
  std::uint32_t height = 24;
  JpegColours colours = JpegColours::kYcc;
  bool progressive = false;
  bool adobe = true;  ///< Adobe's marker in CMYK and YCCK files
};

/// A sample of the smooth picture that jpegFile stores.
std::uint8_t jpegSample(std::uint32_t x, std::uint32_t y, unsigned channel);
std::string jpegFile(const JpegSpec& spec);
/// Offsets of all markers of a JPEG file, in order.
std::vector<std::size_t> jpegMarkers(std::string_view file);

/// @param lossless  exactly these pixels
std::string webpFile(const ImageRgba8& image, bool lossless);
/// Two frames.
std::string webpAnimation();

/// A picture of pngSample's values.
ImageRgba8 noisePicture(std::uint32_t width, std::uint32_t height);

}  // namespace jalousie::test
