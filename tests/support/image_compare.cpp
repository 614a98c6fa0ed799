// Golden images: stored beside the tests, compared under a mean and a share-of-pixels limit.
#include "support/image_compare.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "asset/image_io.h"

namespace jalousie::test {
namespace {

struct Difference {
  double mean = 0.0;
  double largeShare = 0.0;
  ImageRgba8 picture;
};

Difference difference(const ImageRgba8& a, const ImageRgba8& b, int large) {
  Difference result;
  result.picture = {a.width, a.height, std::vector<std::uint8_t>(a.pixels.size(), 255)};
  std::size_t largePixels = 0;
  for (std::size_t pixel = 0; pixel < a.pixels.size(); pixel += 4) {
    int worst = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int delta = std::abs(int{a.pixels[pixel + k]} - int{b.pixels[pixel + k]});
      result.picture.pixels[pixel + k] = static_cast<std::uint8_t>(std::min(255, 8 * delta));
      result.mean += delta;
      worst = std::max(worst, delta);
    }
    largePixels += worst > large ? 1 : 0;
  }
  const auto pixels = static_cast<double>(a.pixels.size() / 4);
  result.mean /= 3.0 * pixels;
  result.largeShare = static_cast<double>(largePixels) / pixels;
  return result;
}

}  // namespace

testing::AssertionResult matchesGolden(const ImageRgba8& frame, const std::string& name, const ImageLimits& limits) {
  const std::filesystem::path stored = std::filesystem::path(JALOUSIE_SOURCE_DIR) / "tests/golden" / (name + ".png");
  if (std::getenv("JALOUSIE_UPDATE_GOLDEN") != nullptr) {
    asset::savePng(frame, stored);
    return testing::AssertionSuccess();
  }
  const ImageRgba8 expected = asset::loadImage(stored);
  if (expected.width != frame.width || expected.height != frame.height)
    return testing::AssertionFailure() << name << ": the stored image has another size";
  const Difference found = difference(frame, expected, limits.large);
  if (found.mean <= limits.mean && found.largeShare <= limits.largeShare) return testing::AssertionSuccess();

  const std::filesystem::path folder = std::filesystem::path(JALOUSIE_BINARY_DIR) / "golden";
  std::filesystem::create_directories(folder);
  asset::savePng(frame, folder / (name + ".actual.png"));
  asset::savePng(expected, folder / (name + ".expected.png"));
  asset::savePng(found.picture, folder / (name + ".difference.png"));
  return testing::AssertionFailure() << name << ": mean difference " << found.mean << " (limit " << limits.mean << "), "
                                     << 100.0 * found.largeShare << " % of the pixels differ by more than "
                                     << limits.large << " (limit " << 100.0 * limits.largeShare << " %); pictures in "
                                     << folder;
}

}  // namespace jalousie::test
