// Butteraugli: its laws, masking, tiles against the whole picture, values against libjxl's own program.
#include "compare/butteraugli.h"

#include <gtest/gtest.h>
#include <jxl/butteraugli.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "asset/image_io.h"
#include "compare/image_error.h"
#include "core/random.h"
#include "support/run_program.h"

namespace jalousie::compare {
namespace {

/// Opaque grey picture of value(x, y).
template <class Value>
ImageRgba8 greys(std::uint32_t width, std::uint32_t height, Value value) {
  ImageRgba8 image{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const auto grey = static_cast<std::uint8_t>(std::clamp(value(static_cast<int>(x), static_cast<int>(y)), 0, 255));
      image.pixels.insert(image.pixels.end(), {grey, grey, grey, 255});
    }
  }
  return image;
}

int randomBetween(Random& random, int least, int most) {
  return least + static_cast<int>(random.below(static_cast<std::uint32_t>(most - least + 1)));
}

/// Waves and noise.
ImageRgba8 scene(std::uint32_t width, std::uint32_t height, std::uint64_t seed = 1) {
  Random random(seed);
  return greys(width, height, [&](int x, int y) {
    const double wave = 60.0 * std::sin(0.1 * x) + 50.0 * std::cos(0.07 * y);
    return 128 + static_cast<int>(wave) + randomBetween(random, 0, 9);
  });
}

ImageRgba8 withNoise(ImageRgba8 image, int step, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (i % 4 != 3)
      image.pixels[i] = static_cast<std::uint8_t>(
          std::clamp(static_cast<int>(image.pixels[i]) + randomBetween(random, -step, step), 0, 255));
  return image;
}

TEST(Butteraugli, EqualPicturesHaveNoDistance) {
  const ButteraugliError error = butteraugli(scene(90, 70), scene(90, 70));
  EXPECT_EQ(error.mean, 0.0);
  EXPECT_EQ(error.largest, 0.0);
}

TEST(Butteraugli, GrowsWithTheNoise) {
  const ImageRgba8 reference = scene(120, 90);
  double last = 0.0;
  for (const int step : {2, 5, 12, 30}) {
    const ButteraugliError error = butteraugli(reference, withNoise(reference, step, 7));
    EXPECT_GT(error.mean, last) << step;
    EXPECT_GT(error.largest, error.mean) << step;
    last = error.mean;
  }
}

TEST(Butteraugli, IgnoresAlpha) {
  const ImageRgba8 reference = scene(64, 48);
  const ImageRgba8 test = withNoise(reference, 9, 2);
  ImageRgba8 clear = test;
  for (std::size_t i = 3; i < clear.pixels.size(); i += 4)
    clear.pixels[i] = static_cast<std::uint8_t>(i % 251);
  EXPECT_EQ(butteraugli(reference, clear).mean, butteraugli(reference, test).mean);
}

TEST(Butteraugli, AnErrorInABusyPlaceCountsLess) {
  // The same step in a square of 12x12 pixels: on a plain ground, and on a ground of strong noise.
  const auto withSquare = [](ImageRgba8 image) {
    for (std::uint32_t y = 42; y < 54; ++y) {
      for (std::size_t i = image.offset(42, y); i < image.offset(54, y); ++i)
        if (i % 4 != 3) image.pixels[i] = static_cast<std::uint8_t>(image.pixels[i] + 12);  // not alpha
    }
    return image;
  };
  const ImageRgba8 plain = greys(96, 96, [](int, int) { return 128; });
  Random random(3);
  const ImageRgba8 busy = greys(96, 96, [&](int, int) { return randomBetween(random, 60, 196); });
  ASSERT_EQ(psnr(plain, withSquare(plain)), psnr(busy, withSquare(busy)));
  const ButteraugliError onPlain = butteraugli(plain, withSquare(plain));
  const ButteraugliError onBusy = butteraugli(busy, withSquare(busy));
  EXPECT_LT(onBusy.mean, 0.7 * onPlain.mean);
  EXPECT_LT(onBusy.largest, 0.7 * onPlain.largest);
}

TEST(Butteraugli, SmallestPicturesAreJudged) {
  const ImageRgba8 a = scene(kLeastSsimSide, kLeastSsimSide, 1);
  const ButteraugliError error = butteraugli(a, withNoise(a, 40, 5));
  EXPECT_GT(error.mean, 0.1);
  EXPECT_TRUE(std::isfinite(error.largest));
}

/// libjxl's own norms of a whole picture.
ButteraugliError ofWholePicture(const ImageRgba8& reference, const ImageRgba8& test) {
  const JxlPixelFormat format{4, JXL_TYPE_UINT8, JXL_NATIVE_ENDIAN, 0};
  JxlButteraugliApi* api = JxlButteraugliApiCreate(nullptr);
  JxlButteraugliApiSetIntensityTarget(api, 80.0F);
  JxlButteraugliApiSetHFAsymmetry(api, 0.8F);
  JxlButteraugliResult* result =
      JxlButteraugliCompute(api, reference.width, reference.height, &format, reference.pixels.data(),
                            reference.pixels.size(), &format, test.pixels.data(), test.pixels.size());
  const ButteraugliError error{static_cast<double>(JxlButteraugliResultGetDistance(result, 3.0F)),
                               static_cast<double>(JxlButteraugliResultGetMaxDistance(result))};
  JxlButteraugliResultDestroy(result);
  JxlButteraugliApiDestroy(api);
  return error;
}

TEST(Butteraugli, TilesHaveTheDistanceOfTheWholePicture) {
  // One tile; two and three tiles along each side, with narrow ones at the end.
  for (const auto& [width, height] : {std::pair{300U, 200U}, {1100U, 1000U}, {1733U, 700U}, {650U, 1750U}}) {
    const ImageRgba8 reference = scene(width, height);
    const ImageRgba8 test = withNoise(reference, 10, 11);
    const ButteraugliError tiles = butteraugli(reference, test);
    const ButteraugliError whole = ofWholePicture(reference, test);
    EXPECT_NEAR(tiles.mean, whole.mean, 1e-5) << width << "x" << height;
    EXPECT_NEAR(tiles.largest, whole.largest, 1e-5) << width << "x" << height;
  }
}

TEST(Butteraugli, MemoryFollowsThePictureUpToATile) {
  EXPECT_LT(butteraugliBytes(100, 100), std::uint64_t{10'000} * 300);
  EXPECT_EQ(butteraugliBytes(16384, 4096), butteraugliBytes(4096, 4096));
  EXPECT_LT(butteraugliBytes(16384, 4096), std::uint64_t{400} << 20U);
}

TEST(Butteraugli, HasTheValuesOfLibjxlsProgram) {
  const std::optional<std::filesystem::path> program = test::findProgram("butteraugli_main");
  if (!program) GTEST_SKIP() << "no butteraugli_main in PATH (Debian package libjxl-devtools)";
  const test::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{160U, 96U}, {123U, 77U}}) {
    const ImageRgba8 reference = scene(width, height);
    const ImageRgba8 test = withNoise(reference, 15, 4);
    asset::savePng(reference, folder / "a.png");
    asset::savePng(test, folder / "b.png");
    const test::ProgramResult said =
        test::runProgram(*program, {(folder / "a.png").string(), (folder / "b.png").string()});
    ASSERT_EQ(said.exitCode, 0) << said.standardError;
    // "LARGEST", then "3-norm: MEAN"
    const std::size_t norm = said.standardOutput.find("3-norm: ");
    ASSERT_NE(norm, std::string::npos) << said.standardOutput;
    const ButteraugliError error = butteraugli(reference, test);
    EXPECT_NEAR(error.largest, std::strtod(said.standardOutput.c_str(), nullptr), 1e-4);
    EXPECT_NEAR(error.mean, std::strtod(said.standardOutput.c_str() + norm + 8, nullptr), 1e-4);
  }
}

}  // namespace
}  // namespace jalousie::compare
