// Tiles for JxlButteraugliCompute, and the norms over all of them.
#include "compare/butteraugli.h"

#include <jxl/butteraugli.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "compare/image_error.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::compare {
namespace {

/// As in libjxl's program butteraugli_main; the library has other defaults. Luminance of white in cd/m2, and how much
/// less lost fine structure counts than added one.
constexpr float kDisplayNits = 80.0F;
constexpr float kAsymmetry = 0.8F;
/// Pixels around a pixel that its distance depends on, rounded up: the filters of libjxl 0.7 reach less than 80 pixels.
/// Even, because half of the analysis runs on pictures of half the size.
constexpr std::uint32_t kMargin = 80;
/// Side of a tile without its margins. Even.
constexpr std::uint32_t kTileSide = 864;
/// Pictures with at most as many pixels as a tile with its margins are processed as a whole.
constexpr std::uint64_t kTilePixels = std::uint64_t{kTileSide + 2 * kMargin} * (kTileSide + 2 * kMargin);

bool fitsOneTile(std::uint32_t width, std::uint32_t height) {
  return std::uint64_t{width} * height <= kTilePixels;
}

struct FreeApi {
  void operator()(JxlButteraugliApi* api) const { JxlButteraugliApiDestroy(api); }
};
struct FreeResult {
  void operator()(JxlButteraugliResult* result) const { JxlButteraugliResultDestroy(result); }
};

/// Columns or rows [first, end) of a tile, and the ones that are compared.
struct Range {
  std::uint32_t first, end, firstWithMargin, endWithMargin;
};

std::vector<Range> rangesOf(std::uint32_t size, std::uint32_t tile) {
  std::vector<Range> ranges;
  for (std::uint32_t first = 0; first < size; first += std::min(tile, size - first)) {
    const std::uint32_t end = first + std::min(tile, size - first);
    ranges.push_back({first, end, first - std::min(first, kMargin), end + std::min(kMargin, size - end)});
  }
  return ranges;
}

/// Red, green and blue of a tile with its margins.
std::vector<std::uint8_t> packed(const ImageRgba8& image, const Range& x, const Range& y) {
  std::vector<std::uint8_t> result;
  result.reserve(std::size_t{3} * (x.endWithMargin - x.firstWithMargin) * (y.endWithMargin - y.firstWithMargin));
  for (std::uint32_t row = y.firstWithMargin; row < y.endWithMargin; ++row) {
    const std::uint8_t* p = &image.pixels[image.offset(x.firstWithMargin, row)];
    for (std::uint32_t column = x.firstWithMargin; column < x.endWithMargin; ++column, p += 4)
      result.insert(result.end(), p, p + 3);
  }
  return result;
}

/// Sums over pixels, of powers of their distances.
struct Sums {
  double cubes = 0.0, sixths = 0.0, twelfths = 0.0;
  double largest = 0.0;

  void add(float distance) {
    const double cube = static_cast<double>(distance) * static_cast<double>(distance) * static_cast<double>(distance);
    cubes += cube;
    sixths += cube * cube;
    twelfths += cube * cube * cube * cube;
    largest = std::max(largest, static_cast<double>(distance));
  }
};

struct Pictures {
  const ImageRgba8& reference;
  const ImageRgba8& test;
};

void addTile(JxlButteraugliApi* api, const Pictures& pictures, const Range& x, const Range& y, Sums& sums) {
  const JxlPixelFormat format{3, JXL_TYPE_UINT8, JXL_NATIVE_ENDIAN, 0};
  const std::vector<std::uint8_t> a = packed(pictures.reference, x, y);
  const std::vector<std::uint8_t> b = packed(pictures.test, x, y);
  const std::unique_ptr<JxlButteraugliResult, FreeResult> result(
      JxlButteraugliCompute(api, x.endWithMargin - x.firstWithMargin, y.endWithMargin - y.firstWithMargin, &format,
                            a.data(), a.size(), &format, b.data(), b.size()));
  if (result == nullptr) throw Error(ErrorCode::kInternal, "libjxl could not compare the pictures with Butteraugli");
  const float* map = nullptr;
  std::uint32_t stride = 0;
  JxlButteraugliResultGetDistmap(result.get(), &map, &stride);
  for (std::uint32_t row = y.first; row < y.end; ++row)
    for (std::uint32_t column = x.first; column < x.end; ++column)
      sums.add(map[std::size_t{row - y.firstWithMargin} * stride + (column - x.firstWithMargin)]);
}

}  // namespace

ButteraugliError butteraugli(const ImageRgba8& reference, const ImageRgba8& test) {
  JAL_CHECK(reference.width == test.width);
  JAL_CHECK(reference.height == test.height);
  JAL_CHECK(reference.width >= kLeastSsimSide);
  JAL_CHECK(reference.height >= kLeastSsimSide);
  const std::unique_ptr<JxlButteraugliApi, FreeApi> api(JxlButteraugliApiCreate(nullptr));
  if (api == nullptr) throw Error(ErrorCode::kInternal, "libjxl could not start Butteraugli");
  JxlButteraugliApiSetIntensityTarget(api.get(), kDisplayNits);
  JxlButteraugliApiSetHFAsymmetry(api.get(), kAsymmetry);
  Sums sums;
  const bool whole = fitsOneTile(reference.width, reference.height);
  for (const Range& y : rangesOf(reference.height, whole ? reference.height : kTileSide))
    for (const Range& x : rangesOf(reference.width, whole ? reference.width : kTileSide))
      addTile(api.get(), {reference, test}, x, y, sums);
  // libjxl's norm: the mean of three norms of the distances, with the exponents 3, 6 and 12.
  const double count = static_cast<double>(reference.width) * reference.height;
  const double mean = (std::pow(sums.cubes / count, 1.0 / 3.0) + std::pow(sums.sixths / count, 1.0 / 6.0) +
                       std::pow(sums.twelfths / count, 1.0 / 12.0)) /
                      3.0;
  return {mean, sums.largest};
}

std::uint64_t butteraugliBytes(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint64_t kPixelBytes = 280;  // of libjxl 0.7: 260 measured
  return kPixelBytes * std::min(std::uint64_t{width} * height, kTilePixels);
}

}  // namespace jalousie::compare
