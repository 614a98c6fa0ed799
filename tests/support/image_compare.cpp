// Differences of images, and the pictures of a failed comparison.
#include "support/image_compare.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "asset/image_io.h"
#include "core/check.h"

namespace jalousie::test {
namespace {

/// Largest channel difference of two pixels, alpha left out. @param a, b  offsets of their first bytes
int pixelDifference(const ImageRgba8& frame, std::size_t a, const ImageRgba8& expected, std::size_t b) {
  int worst = 0;
  for (std::size_t k = 0; k < 3; ++k)
    worst = std::max(worst, std::abs(int{frame.pixels[a + k]} - int{expected.pixels[b + k]}));
  return worst;
}

/// Difference of a pixel from the nearest of the 3 x 3 expected pixels around it.
int neighbourhoodDifference(const ImageRgba8& frame, const ImageRgba8& expected, std::uint32_t x, std::uint32_t y) {
  int least = 255;
  for (std::uint32_t ny = y > 0 ? y - 1 : 0; ny <= std::min(y + 1, expected.height - 1); ++ny)
    for (std::uint32_t nx = x > 0 ? x - 1 : 0; nx <= std::min(x + 1, expected.width - 1); ++nx)
      least = std::min(least, pixelDifference(frame, frame.offset(x, y), expected, expected.offset(nx, ny)));
  return least;
}

bool within(const ImageDifference& found, const ImageLimits& limits) {
  return found.mean <= limits.mean && found.largeShare <= limits.largeShare && found.maximum <= limits.maximum;
}

}  // namespace

ImageDifference differenceOf(const ImageRgba8& frame, const ImageRgba8& expected, const ImageLimits& limits) {
  JAL_CHECK(frame.width == expected.width);
  JAL_CHECK(frame.height == expected.height);
  ImageDifference result;
  result.picture = {frame.width, frame.height, std::vector<std::uint8_t>(frame.pixels.size(), 255)};
  std::size_t largePixels = 0;
  for (std::uint32_t y = 0; y < frame.height; ++y) {
    for (std::uint32_t x = 0; x < frame.width; ++x) {
      const std::size_t pixel = frame.offset(x, y);
      for (std::size_t k = pixel; k < pixel + 3; ++k) {
        const int delta = std::abs(int{frame.pixels[k]} - int{expected.pixels[k]});
        result.picture.pixels[k] = static_cast<std::uint8_t>(std::min(255, 8 * delta));
        result.mean += delta;
      }
      largePixels += pixelDifference(frame, pixel, expected, pixel) > limits.large ? 1 : 0;
      result.maximum = std::max(result.maximum, neighbourhoodDifference(frame, expected, x, y));
    }
  }
  const auto pixels = static_cast<double>(frame.pixels.size() / 4);
  result.mean /= 3.0 * pixels;
  result.largeShare = static_cast<double>(largePixels) / pixels;
  return result;
}

testing::AssertionResult matchesImage(const ImageRgba8& frame, const ImageRgba8& expected, const std::string& name,
                                      const ImageLimits& limits) {
  if (expected.width != frame.width || expected.height != frame.height)
    return testing::AssertionFailure() << name << ": the stored image has another size";
  const ImageDifference found = differenceOf(frame, expected, limits);
  if (within(found, limits)) return testing::AssertionSuccess();
  const std::filesystem::path folder = std::filesystem::path(JALOUSIE_BINARY_DIR) / "golden";
  std::filesystem::create_directories(folder);
  const std::filesystem::path actual = folder / (name + ".actual.png");
  const std::filesystem::path stored = folder / (name + ".expected.png");
  const std::filesystem::path difference = folder / (name + ".difference.png");
  asset::savePng(frame, actual);
  asset::savePng(expected, stored);
  asset::savePng(found.picture, difference);
  return testing::AssertionFailure() << name << ": mean difference " << found.mean << " (limit " << limits.mean << "); "
                                     << 100.0 * found.largeShare << " % of the pixels differ by more than "
                                     << limits.large << " (limit " << 100.0 * limits.largeShare
                                     << " %); largest difference from a neighbourhood " << found.maximum << " (limit "
                                     << limits.maximum << "). Pictures: " << actual << ", " << stored << ", "
                                     << difference;
}

testing::AssertionResult matchesGolden(const ImageRgba8& frame, const std::string& name, const ImageLimits& limits) {
  const std::filesystem::path stored = std::filesystem::path(JALOUSIE_SOURCE_DIR) / "tests/golden" / (name + ".png");
  if (std::getenv("JALOUSIE_UPDATE_GOLDEN") != nullptr) {
    asset::savePng(frame, stored);
    return testing::AssertionSuccess();
  }
  return matchesImage(frame, asset::loadImage(stored), name, limits);
}

}  // namespace jalousie::test
