// The limits of the golden images: what passes, what fails, and which files a failure leaves.
#include "support/image_compare.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace jalousie::test {
namespace {

/// A dark picture with a bright square.
ImageRgba8 square(std::uint32_t left) {
  ImageRgba8 image{64, 64, std::vector<std::uint8_t>(std::size_t{64} * 64 * 4, 255)};
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x)
      for (std::size_t k = 0; k < 3; ++k)
        image.pixels[image.offset(x, y) + k] = x >= left && x < left + 8 && y >= 20 && y < 28 ? 220 : 20;
  return image;
}

TEST(ImageCompare, RoundingAndAnEdgeThatMovedByAPixelPass) {
  ImageRgba8 rounded = square(20);
  for (std::size_t i = 0; i < rounded.pixels.size(); i += 16)
    ++rounded.pixels[i];
  EXPECT_TRUE(matchesImage(rounded, square(20), "image_compare_rounding"));
  const ImageDifference moved = differenceOf(square(21), square(20));
  EXPECT_EQ(moved.maximum, 0) << "every colour is in its neighbourhood";
  EXPECT_GT(moved.mean, 0.5);
}

TEST(ImageCompare, OnePixelOfAForeignColourFailsByTheMaximumAlone) {
  ImageRgba8 foreign = square(20);
  foreign.pixels[foreign.offset(50, 50)] = 220;
  const ImageDifference found = differenceOf(foreign, square(20));
  EXPECT_LT(found.mean, 0.05);
  EXPECT_LT(found.largeShare, 0.001);
  EXPECT_EQ(found.maximum, 200);
  const testing::AssertionResult result = matchesImage(foreign, square(20), "image_compare_foreign");
  EXPECT_FALSE(result);
  for (const char* kind : {"actual", "expected", "difference"}) {
    const std::string name = std::string("image_compare_foreign.") + kind + ".png";
    EXPECT_NE(std::string(result.message()).find(name), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(JALOUSIE_BINARY_DIR) / "golden" / name)) << name;
  }
}

TEST(ImageCompare, ASmallDifferenceEverywhereFailsByTheMeanAlone) {
  ImageRgba8 brighter = square(20);
  for (std::uint8_t& byte : brighter.pixels)
    byte = static_cast<std::uint8_t>(byte < 255 ? byte + 2 : byte);
  EXPECT_LE(differenceOf(brighter, square(20)).maximum, 2);
  EXPECT_FALSE(matchesImage(brighter, square(20), "image_compare_brighter"));
}

TEST(ImageCompare, AnotherSizeFails) {
  EXPECT_FALSE(matchesImage(ImageRgba8{1, 1, {0, 0, 0, 255}}, square(20), "image_compare_size"));
}

}  // namespace
}  // namespace jalousie::test
