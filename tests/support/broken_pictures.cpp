// Breaks the files of picture_writer.h one property at a time.
#include "support/broken_pictures.h"

#include <algorithm>
#include <random>
#include <set>
#include <string_view>

#include "core/check.h"
#include "support/picture_writer.h"

namespace jalousie::test {
namespace {

using enum ErrorCode;

/// Position of the first marker 0xFF `code` of a JPEG.
std::size_t markerAt(const std::string& file, std::uint8_t code) {
  for (const std::size_t at : jpegMarkers(file))
    if (static_cast<std::uint8_t>(file[at + 1]) == code) return at;
  JAL_CHECK(code == 0);
  return 0;
}

constexpr std::uint8_t kSof0 = 0xC0;
constexpr std::uint8_t kSof2 = 0xC2;
constexpr std::uint8_t kDht = 0xC4;
constexpr std::uint8_t kSos = 0xDA;

std::string withByte(std::string file, std::size_t at, unsigned value) {
  file.at(at) = static_cast<char>(value);
  return file;
}

std::string jpegOfSize(std::uint32_t width, std::uint32_t height) {
  std::string file = jpegFile({});
  const std::size_t frame = markerAt(file, kSof0);
  file = withByte(withByte(file, frame + 5, height >> 8U), frame + 6, height & 255U);
  return withByte(withByte(file, frame + 7, width >> 8U), frame + 8, width & 255U);
}

/// A table that says 16 * 255 codes.
std::string jpegWithManyCodes() {
  std::string file = jpegFile({});
  std::string table = std::string("\xFF\xC4", 2) + std::string("\x10\x03\x00", 3);  // 2 + 1 + 16 + 4080 bytes
  table += std::string(16, '\xFF') + std::string(16 * 255, '\1');
  return file.insert(markerAt(file, kDht), table);
}

std::string jpegWithManyScans() {
  std::string file = jpegFile({.progressive = true});
  const std::vector<std::size_t> markers = jpegMarkers(file);
  const std::size_t scan = markerAt(file, kSos);
  const std::size_t next = *std::upper_bound(markers.begin(), markers.end(), scan);
  std::string scans;
  for (int i = 0; i < 3000; ++i)
    scans += file.substr(scan, next - scan);
  return file.insert(next, scans);
}

std::string jpegWithHole() {
  std::string file = jpegFile({.width = 160, .height = 160});
  const std::size_t scan = markerAt(file, kSos) + 14;
  file.erase(scan + 100, file.size() - scan - 102);  // up to EOI
  return file;
}

void addJpegs(std::vector<BrokenPicture>& list) {
  const std::string file = jpegFile({});
  const std::size_t frame = markerAt(file, kSof0);
  list.push_back({"many-codes.jpg", jpegWithManyCodes(), kMalformed, "Bogus Huffman table"});
  list.push_back({"no-width.jpg", jpegOfSize(0, 24), kMalformed, "Empty JPEG image"});
  list.push_back({"no-height.jpg", jpegOfSize(40, 0), kMalformed, "Empty JPEG image"});
  list.push_back({"65535.jpg", jpegOfSize(65535, 65535), kLimit, "65500 pixels"});
  list.push_back({"65500.jpg", jpegOfSize(65500, 65500), kLimit, "the limit is 16384 a side"});
  list.push_back({"16384.jpg", jpegOfSize(16384, 16384), kLimit, "the limit is 67108864 in all"});
  list.push_back({"few-bytes.jpg", jpegOfSize(8000, 8000), kMalformed, "cannot hold 8000 x 8000 pixels"});
  list.push_back({"many-scans.jpg", jpegWithManyScans(), kLimit, "more than 100 scans"});
  list.push_back({"arithmetic.jpg", withByte(file, frame + 1, 0xC9), kUnsupported, "arithmetic"});
  list.push_back({"lossless.jpg", withByte(file, frame + 1, 0xC3), kUnsupported, "SOF type 0xc3"});
  list.push_back({"twelve-bits.jpg", withByte(file, frame + 4, 12), kUnsupported, "precision 12"});
  list.push_back({"hole.jpg", jpegWithHole(), kMalformed, "premature end of data segment"});
  list.push_back({"no-quantisation.jpg", withByte(file, frame + 12, 3), kMalformed, "Quantization table"});
}

/// @param chunk  of which a byte of the checksum is flipped
std::string pngWithWrongSum(const PngSpec& spec, std::string_view chunk) {
  std::string file = pngFile(spec);
  const std::size_t type = file.find(chunk);
  JAL_CHECK(type != std::string::npos);
  const std::size_t length =
      static_cast<std::uint8_t>(file[type - 1]) + 256U * static_cast<std::uint8_t>(file[type - 2]);
  return withByte(file, type + 4 + length, static_cast<std::uint8_t>(file[type + 4 + length]) ^ 1U);
}

std::string palette(std::size_t colours) {
  std::string data;
  for (std::size_t i = 0; i < 3 * colours; ++i)
    data += static_cast<char>(37 * i);
  return pngChunk("PLTE", data);
}

void addPngs(std::vector<BrokenPicture>& list) {
  const std::string end = pngChunk("IEND", "");
  const std::string clear = pngChunk("tRNS", std::string("\0\7", 2));
  const PngSpec few{.depth = 4, .colourType = 3, .before = palette(9)};
  const std::string longClear = pngChunk("tRNS", std::string(20, '\1'));
  list.push_back({"header-sum.png", pngWithWrongSum({}, "IHDR"), kMalformed, "IHDR: CRC error"});
  list.push_back({"data-sum.png", pngWithWrongSum({}, "IDAT"), kMalformed, "IDAT: CRC error"});
  list.push_back({"palette-sum.png", pngWithWrongSum(few, "PLTE"), kMalformed, "PLTE: CRC error"});
  list.push_back(
      {"clear-sum.png", pngWithWrongSum({.colourType = 0, .before = clear}, "tRNS"), kMalformed, "tRNS: CRC error"});
  list.push_back({"clear-long.png", pngFile({.depth = 4, .colourType = 3, .before = palette(16) + longClear}),
                  kMalformed, "tRNS: invalid"});
  list.push_back({"palette-absent.png", pngFile({.colourType = 3}), kMalformed, "Missing PLTE before IDAT"});
  list.push_back({"no-width.png", pngFile({.width = 0}), kMalformed, "Invalid IHDR data"});
  list.push_back({"2-31.png", pngHeader({.width = 1U << 31U}) + end, kMalformed, "PNG unsigned integer out of range"});
  list.push_back({"2-31-1.png", pngHeader({.width = (1U << 31U) - 1}) + pngChunk("IDAT", "") + end, kLimit,
                  "the limit is 16384 a side"});
  list.push_back({"bomb.png", pngHeader({.width = 16384, .height = 16384}) + pngChunk("IDAT", zlibZeros(1024)) + end,
                  kLimit, "the limit is 67108864 in all"});
  list.push_back({"data-bomb.png", pngHeader({}) + pngChunk("IDAT", zlibZeros(1024)) + end, kMalformed,
                  "far too much image data"});
  list.push_back({"few-bytes.png", pngHeader({.width = 8000, .height = 8000}) + pngChunk("IDAT", "") + end, kMalformed,
                  "cannot hold 8000 x 8000 pixels"});
  list.push_back(
      {"few-rows.png",
       pngHeader({.width = 4096, .height = 4096}) + pngChunk("IDAT", zlibZeros(4)) + std::string(1U << 16U, '\0'),
       kMalformed, "Not enough image data"});
  list.push_back({"depth.png", pngHeader({.depth = 3}) + end, kMalformed, "Invalid IHDR data"});
  list.push_back({"no-stream.png", pngHeader({}) + pngChunk("IDAT", "nothing of zlib") + end, kMalformed,
                  "IDAT: incorrect header check"});
}

void addOthers(std::vector<BrokenPicture>& list) {
  const std::string webp = webpFile(noisePicture(16, 16), true);
  list.push_back({"animation.webp", webpAnimation(), kUnsupported, "animation"});
  list.push_back({"signature.webp", withByte(webp, 20, 0), kMalformed, "the WebP is broken"});
  list.push_back({"16384.webp", webp.substr(0, 21) + std::string(8, '\xFF'), kMalformed, "the WebP is broken"});
  list.push_back({"bmp.png", "BM" + std::string(60, '\0'), kUnsupported, "BMP"});
  list.push_back({"gif.png", std::string("GIF89a\1\0\1\0\0\0\0;", 14), kUnsupported, "GIF"});
  list.push_back(
      {"tga.png", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\30\0\1\2\3", 21), kUnsupported, "neither PNG"});
  list.push_back({"hdr.png", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n", kUnsupported, "Radiance HDR"});
  list.push_back({"psd.png", std::string("8BPS\0\1", 6) + std::string(20, '\1'), kUnsupported, "PSD"});
  list.push_back({"ktx2.png", "\xABKTX 20\xBB\r\n\x1A\n" + std::string(60, '\0'), kUnsupported, "KTX2"});
}

/// @param places  where chunks or markers begin
void addCuts(std::vector<BrokenPicture>& list, const std::string& name, const std::string& file,
             const std::vector<std::size_t>& places) {
  std::set<std::size_t> sizes;
  for (const std::size_t place : places)
    for (std::size_t more = 0; more < 5; ++more)
      sizes.insert(place + more);
  std::mt19937 random(static_cast<unsigned>(file.size()));
  for (int i = 0; i < 50; ++i)
    sizes.insert(random() % file.size());
  for (const std::size_t size : sizes)
    if (size >= 12 && size < file.size())  // the format is known by the first twelve bytes
      list.push_back({name + "-" + std::to_string(size), file.substr(0, size), kMalformed, "is broken"});
}

std::vector<std::size_t> pngChunkStarts(const std::string& file) {
  std::vector<std::size_t> starts;
  for (const char* type : {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"})
    if (const std::size_t at = file.find(type); at != std::string::npos) starts.push_back(at - 4);
  return starts;
}

}  // namespace

std::vector<BrokenPicture> brokenPictures() {
  std::vector<BrokenPicture> list;
  addJpegs(list);
  addPngs(list);
  addOthers(list);
  return list;
}

std::vector<BrokenPicture> cutPictures() {
  std::vector<BrokenPicture> list;
  for (const bool progressive : {false, true}) {
    const std::string file = jpegFile({.progressive = progressive});
    addCuts(list, progressive ? "progressive" : "sequential", file, jpegMarkers(file));
  }
  for (const bool interlaced : {false, true}) {
    const std::string file = pngFile({.depth = 4, .colourType = 3, .interlaced = interlaced, .before = palette(16)});
    addCuts(list, interlaced ? "interlaced" : "rows", file, pngChunkStarts(file));
  }
  for (const bool lossless : {false, true})
    addCuts(list, lossless ? "lossless" : "lossy", webpFile(noisePicture(32, 16), lossless), {20, 30});
  return list;
}

std::vector<OddPicture> oddPictures() {
  const std::string jpeg = jpegFile({});
  const std::string bomb = std::string("a\0\0", 3) + zlibZeros(1024);
  const std::string noClear = pngChunk("tRNS", std::string("\0\7", 2));
  return {{"text-bomb.png", pngFile({.before = pngChunk("zTXt", bomb)})},
          {"profile-bomb.png", pngFile({.before = pngChunk("iCCP", bomb)})},
          {"text-sum.png", pngWithWrongSum({.before = pngChunk("tEXt", "a")}, "tEXt")},
          {"gamma.png", pngFile({.before = pngChunk("gAMA", std::string("\0\1\x86\xA0", 4))})},
          {"alpha-twice.png", pngFile({.before = noClear})},
          {"palette-short.png", pngFile({.depth = 4, .colourType = 3, .before = palette(9)})},
          {"more-behind.png", pngFile({}) + "more"},
          {"more-behind.jpg", jpeg + "more"},
          {"more-before-marker.jpg", std::string(jpeg).insert(jpegMarkers(jpeg)[2], "some")}};
}

}  // namespace jalousie::test
