// Image errors: their laws, FLIP against a second implementation, SSIM and PSNR against ffmpeg.
#include "compare/image_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "asset/image_io.h"
#include "core/random.h"
#include "support/run_program.h"

namespace jalousie::compare {
namespace {

using Rgb = std::array<int, 3>;

constexpr Rgb kBlack = {0, 0, 0};
constexpr Rgb kWhite = {255, 255, 255};
constexpr Rgb kGreen = {0, 255, 0};
constexpr Rgb kBlue = {0, 0, 255};

std::uint8_t toByte(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

/// Opaque picture of colour(x, y).
template <class Color>
ImageRgba8 paint(std::uint32_t width, std::uint32_t height, Color color) {
  ImageRgba8 image{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const Rgb rgb = color(static_cast<int>(x), static_cast<int>(y));
      for (const int channel : rgb)
        image.pixels.push_back(toByte(channel));
      image.pixels.push_back(255);
    }
  }
  return image;
}

ImageRgba8 uniform(std::uint32_t width, std::uint32_t height, const Rgb& color) {
  return paint(width, height, [&](int, int) { return color; });
}

ImageRgba8 noise(std::uint32_t width, std::uint32_t height, std::uint64_t seed) {
  Random random(seed);
  const auto byte = [&] { return static_cast<int>(random.below(256)); };
  return paint(width, height, [&](int, int) {
    const int red = byte();
    const int green = byte();
    return Rgb{red, green, byte()};
  });
}

/// Ramps, rings, bars, a disc and lines of one pixel.
ImageRgba8 structure(std::uint32_t width, std::uint32_t height, int shift = 0) {
  return paint(width, height, [&](int x, int y) {
    const int u = x + shift;
    const double fromCentre = std::hypot(u - 0.4 * width, y - 0.5 * height);
    if (fromCentre < 0.15 * height) return Rgb{230, 60, 40};
    if (u % 13 == 0 || y % 11 == 0) return Rgb{20, 20, 30};
    return Rgb{static_cast<int>(255.0 * x / width), static_cast<int>(128.0 + 100.0 * std::sin(0.8 * fromCentre)),
               u / 5 % 2 == 0 ? 210 : 90};
  });
}

/// Squares of 3x3 pixels in the corners of the colour cube.
ImageRgba8 saturated(std::uint32_t width, std::uint32_t height, std::uint64_t seed) {
  return paint(width, height, [&](int x, int y) {
    Random random(seed + static_cast<std::uint64_t>(y / 3 * 1000 + x / 3));
    const std::uint32_t corner = random.below(8);
    return Rgb{(corner & 1U) != 0 ? 255 : 0, (corner & 2U) != 0 ? 255 : 0, (corner & 4U) != 0 ? 255 : 0};
  });
}

/// Adds `step` to every colour channel, or a number of its size with a random sign.
ImageRgba8 brightened(ImageRgba8 image, int step) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (i % 4 != 3) image.pixels[i] = toByte(image.pixels[i] + step);
  return image;
}
ImageRgba8 roughened(ImageRgba8 image, int step, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (i % 4 != 3) image.pixels[i] = toByte(image.pixels[i] + (random.below(2) == 0 ? step : -step));
  return image;
}

/// Mean of the (2 radius + 1)^2 pixels around each; fewer at the border.
ImageRgba8 blurred(const ImageRgba8& image, int radius) {
  return paint(image.width, image.height, [&](int x, int y) {
    Rgb sum = {};
    int count = 0;
    for (int v = std::max(y - radius, 0); v <= std::min<int>(y + radius, static_cast<int>(image.height) - 1); ++v) {
      for (int u = std::max(x - radius, 0); u <= std::min<int>(x + radius, static_cast<int>(image.width) - 1);
           ++u, ++count) {
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] += image.pixels[image.offset(static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v)) + c];
      }
    }
    return Rgb{sum[0] / count, sum[1] / count, sum[2] / count};
  });
}

ImageRgba8 withAlpha(ImageRgba8 image, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] = static_cast<std::uint8_t>(random.below(256));
  return image;
}

ImageRgba8 transposed(const ImageRgba8& image) {
  return paint(image.height, image.width, [&](int x, int y) {
    const std::uint8_t* p = &image.pixels[image.offset(static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x))];
    return Rgb{p[0], p[1], p[2]};
  });
}

ImageRgba8 turned(const ImageRgba8& image) {
  return paint(image.width, image.height, [&](int x, int y) {
    const std::uint8_t* p = &image.pixels[image.offset(image.width - 1 - static_cast<std::uint32_t>(x),
                                                       image.height - 1 - static_cast<std::uint32_t>(y))];
    return Rgb{p[0], p[1], p[2]};
  });
}

std::vector<float> flip(const ImageRgba8& a, const ImageRgba8& b, double pixelsPerDegree = kDefaultPixelsPerDegree) {
  return flipMap(FlipImage(a, pixelsPerDegree), FlipImage(b, pixelsPerDegree));
}

double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = a.size() == b.size() ? 0.0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  return largest;
}

using Pair = std::pair<ImageRgba8, ImageRgba8>;

/// Pictures that differ little, much, in places, and everywhere.
std::vector<Pair> pairs(std::uint32_t width, std::uint32_t height) {
  return {{noise(width, height, 1), noise(width, height, 2)},
          {structure(width, height), structure(width, height, 1)},
          {structure(width, height), blurred(structure(width, height), 1)},
          {structure(width, height), roughened(structure(width, height), 2, 3)},
          {saturated(width, height, 4), saturated(width, height, 5)},
          {saturated(width, height, 6), structure(width, height)},
          {uniform(width, height, kWhite), noise(width, height, 7)}};
}

TEST(Psnr, EqualPicturesHaveNoError) {
  EXPECT_TRUE(std::isinf(psnr(noise(20, 10, 1), noise(20, 10, 1))));
  EXPECT_GT(psnr(noise(20, 10, 1), noise(20, 10, 1)), 0.0);
}

TEST(Psnr, OfAUniformDifferenceIsThatOfItsSize) {
  const ImageRgba8 grey = uniform(33, 17, {100, 100, 100});
  for (const int step : {1, 3, 16, 100})
    EXPECT_NEAR(psnr(grey, brightened(grey, step)), 20.0 * std::log10(255.0 / step), 1e-9) << step;
  EXPECT_NEAR(psnr(uniform(5, 5, kBlack), uniform(5, 5, kWhite)), 0.0, 1e-12);
}

TEST(Psnr, ChannelsCountEqually) {
  const ImageRgba8 grey = uniform(9, 9, {100, 100, 100});
  for (const Rgb& color : {Rgb{110, 100, 100}, {100, 90, 100}, {100, 100, 110}})
    EXPECT_NEAR(psnr(grey, uniform(9, 9, color)), 10.0 * std::log10(3.0 * 255.0 * 255.0 / 100.0), 1e-9);
}

TEST(Psnr, IgnoresAlpha) {
  const ImageRgba8 a = noise(16, 16, 1);
  const ImageRgba8 b = noise(16, 16, 2);
  EXPECT_EQ(psnr(withAlpha(a, 3), withAlpha(b, 4)), psnr(a, b));
  EXPECT_TRUE(std::isinf(psnr(withAlpha(a, 3), a)));
}

TEST(Psnr, IsSymmetric) {
  for (const auto& [a, b] : pairs(31, 18))
    EXPECT_EQ(psnr(a, b), psnr(b, a));
}

TEST(Ssim, EqualPicturesScoreOne) {
  for (const auto& [a, b] : pairs(31, 18)) {
    EXPECT_DOUBLE_EQ(ssim(a, a), 1.0);
    EXPECT_LT(ssim(a, b), 1.0);
  }
}

TEST(Ssim, IsSymmetric) {
  for (const auto& [a, b] : pairs(31, 18))
    EXPECT_DOUBLE_EQ(ssim(a, b), ssim(b, a));
}

TEST(Ssim, StaysBetweenMinusOneAndOne) {
  for (const auto& [a, b] : pairs(31, 18)) {
    EXPECT_GE(ssim(a, b), -1.0);
    EXPECT_LE(ssim(a, b), 1.0);
  }
}

TEST(Ssim, IgnoresAlpha) {
  const ImageRgba8 a = noise(16, 16, 1);
  const ImageRgba8 b = structure(16, 16);
  EXPECT_EQ(ssim(withAlpha(a, 3), withAlpha(b, 4)), ssim(a, b));
}

TEST(Ssim, OfUniformPicturesComparesTheirMeans) {
  constexpr double kC1 = 0.01 * 255.0 * 0.01 * 255.0;
  for (const auto& [a, b] : {std::pair{10, 20}, {100, 110}, {0, 255}})
    EXPECT_NEAR(ssim(uniform(24, 16, {a, a, a}), uniform(24, 16, {b, b, b})),
                (2.0 * a * b + kC1) / (a * a + b * b + kC1), 1e-12);
}

TEST(Ssim, OfOneWindowIsWhatThePublishedConstantsGive) {
  // A window of 8x8 pixels, half of them `left` and half `right`. With n - 1 = 63, halves of 100 and 110 have the mean
  // 105 and the variance 64 * 5 * 5 / 63 = 1600 / 63. The paper's constants are C1 = (0.01 * 255)^2 = 6.5025 and
  // C2 = (0.03 * 255)^2 = 58.5225.
  const auto halves = [](int left, int right) {
    return paint(kLeastSsimSide, kLeastSsimSide, [&](int x, int) {
      const int grey = x < 4 ? left : right;
      return Rgb{grey, grey, grey};
    });
  };
  // Equal means, the covariance -1600 / 63: (58.5225 - 3200 / 63) / (58.5225 + 3200 / 63).
  EXPECT_NEAR(ssim(halves(100, 110), halves(110, 100)), 0.070701805, 1e-9);
  // Means 105 and 110, variances 1600 / 63 and 6400 / 63, the covariance 3200 / 63:
  // (2 * 105 * 110 + 6.5025) (6400 / 63 + 58.5225) / ((105^2 + 110^2 + 6.5025) (8000 / 63 + 58.5225)).
  EXPECT_NEAR(ssim(halves(100, 110), halves(100, 120)), 0.862161968, 1e-9);
}

TEST(Ssim, ForgivesBrightnessAndNotStructure) {
  // The same squared error: once as a step that leaves the structure, once as noise that hides it.
  const ImageRgba8 scene = blurred(structure(96, 64), 2);
  const ImageRgba8 brighter = brightened(scene, 12);
  const ImageRgba8 rough = roughened(scene, 12, 5);
  ASSERT_NEAR(psnr(scene, brighter), psnr(scene, rough), 0.2);
  EXPECT_GT(ssim(scene, brighter), ssim(scene, rough) + 0.1);
}

TEST(Ssim, FallsAsNoiseGrows) {
  const ImageRgba8 scene = blurred(structure(96, 64), 1);
  double last = 1.0;
  for (const int step : {2, 4, 8, 16, 32}) {
    const double score = ssim(scene, roughened(scene, step, 5));
    EXPECT_LT(score, last) << step;
    last = score;
  }
}

TEST(Ssim, ContraryStructureScoresBelowZero) {
  const ImageRgba8 a = noise(40, 40, 1);
  const ImageRgba8 contrary = paint(40, 40, [&](int x, int y) {
    const std::uint8_t* p = &a.pixels[a.offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))];
    return Rgb{255 - p[0], 255 - p[1], 255 - p[2]};
  });
  EXPECT_LT(ssim(a, contrary), -0.5);
}

TEST(Ssim, SmallestPictureIsOneWindow) {
  const ImageRgba8 a = noise(kLeastSsimSide, kLeastSsimSide, 1);
  EXPECT_DOUBLE_EQ(ssim(a, a), 1.0);
  EXPECT_LT(ssim(a, noise(kLeastSsimSide, kLeastSsimSide, 2)), 0.5);
}

TEST(Flip, EqualPicturesHaveNoError) {
  for (const auto& [a, b] : pairs(40, 30))
    for (const float error : flip(a, a))
      ASSERT_EQ(error, 0.0F);
}

TEST(Flip, IsSymmetric) {
  for (const auto& [a, b] : pairs(40, 30))
    EXPECT_LT(largestDifference(flip(a, b), flip(b, a)), 1e-6);
}

TEST(Flip, StaysBetweenZeroAndOne) {
  for (const double pixelsPerDegree : {kLeastPixelsPerDegree, 20.0, kDefaultPixelsPerDegree, 200.0}) {
    for (const auto& [a, b] : pairs(24, 18)) {
      for (const float error : flip(a, b, pixelsPerDegree)) {
        ASSERT_GE(error, 0.0F);
        ASSERT_LE(error, 1.0F);
      }
    }
  }
}

TEST(Flip, IgnoresAlpha) {
  const ImageRgba8 a = structure(24, 18);
  const ImageRgba8 b = noise(24, 18, 2);
  EXPECT_EQ(flip(withAlpha(a, 3), withAlpha(b, 4)), flip(a, b));
}

TEST(Flip, MapFollowsTurnedAndTransposedPictures) {
  for (const auto& [a, b] : pairs(24, 17)) {
    const std::vector<float> map = flip(a, b);
    std::vector<float> around = map;
    std::reverse(around.begin(), around.end());
    EXPECT_LT(largestDifference(flip(turned(a), turned(b)), around), 1e-3);
    std::vector<float> across(map.size());
    for (std::size_t y = 0; y < 17; ++y)
      for (std::size_t x = 0; x < 24; ++x)
        across[x * 17 + y] = map[y * 24 + x];
    EXPECT_LT(largestDifference(flip(transposed(a), transposed(b)), across), 1e-3);
  }
}

TEST(Flip, ErrorReachesNoFurtherThanTheEyeBlurs) {
  const ImageRgba8 a = structure(60, 60);
  ImageRgba8 b = a;
  for (std::size_t c = 0; c < 3; ++c)
    b.pixels[b.offset(30, 30) + c] ^= 0xFFU;
  // The filter of blue and yellow, the widest: three deviations, rounded up to pixels.
  const double reach = std::ceil(3.0 * std::sqrt(0.04 / 2.0) / std::numbers::pi * kDefaultPixelsPerDegree);
  const std::vector<float> map = flip(a, b);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      if (std::max(std::abs(x - 30), std::abs(y - 30)) > reach) {
        ASSERT_EQ(map[60 * static_cast<std::size_t>(y) + static_cast<std::size_t>(x)], 0.0F) << x << " " << y;
      }
    }
  }
  EXPECT_GT(map[60 * 30 + 30], 0.1F);
}

TEST(Flip, DistanceHidesFineNoise) {
  const ImageRgba8 grey = uniform(64, 48, {128, 128, 128});
  const ImageRgba8 rough = roughened(grey, 40, 8);
  double last = 1.0;
  for (const double pixelsPerDegree : {5.0, 10.0, 20.0, 40.0, 80.0, 160.0}) {
    const double error = mean(flip(grey, rough, pixelsPerDegree));
    EXPECT_LT(error, last) << pixelsPerDegree;
    last = error;
  }
}

TEST(Flip, UniformPicturesDifferAlikeEverywhereAndAtAnyDistance) {
  // They have no edges and no points, so that colour alone counts.
  const ImageRgba8 a = uniform(30, 20, {40, 90, 200});
  const ImageRgba8 b = uniform(30, 20, {60, 80, 180});
  const double error = static_cast<double>(flip(a, b).front());
  for (const double pixelsPerDegree : {1.0, 1.5, 2.0, 3.0, 10.0, 20.0, kDefaultPixelsPerDegree, 300.0})
    for (const float value : flip(a, b, pixelsPerDegree))
      ASSERT_NEAR(static_cast<double>(value), error, 2e-3) << pixelsPerDegree;
}

TEST(Flip, GreenAndBlueAreFurthestApart) {
  EXPECT_NEAR(mean(flip(uniform(20, 20, kGreen), uniform(20, 20, kBlue))), 1.0, 1e-5);
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned k = 0; k < i; ++k) {
      const auto corner = [](unsigned bits) {
        return Rgb{(bits & 1U) != 0 ? 255 : 0, (bits & 2U) != 0 ? 255 : 0, (bits & 4U) != 0 ? 255 : 0};
      };
      if (i == 4 && k == 2) continue;  // these two
      EXPECT_LT(mean(flip(uniform(12, 12, corner(i)), uniform(12, 12, corner(k)))), 0.9999) << i << " " << k;
    }
  }
}

TEST(Flip, BlackAndWhiteAreJustBeyondTheKnee) {
  // Lightness 100 apart; the knee at 0.4 of the largest distance has the value 0.95.
  const double error = mean(flip(uniform(20, 20, kBlack), uniform(20, 20, kWhite)));
  EXPECT_GT(error, 0.95);
  EXPECT_LT(error, 0.98);
}

TEST(Flip, GrowsWithTheStepBetweenGreys) {
  double last = 0.0;
  for (const int step : {1, 2, 4, 8, 16, 32, 64, 127}) {
    const double error = mean(flip(uniform(12, 12, {128, 128, 128}), uniform(12, 12, {128 + step, 128, 128 + step})));
    EXPECT_GT(error, last) << step;
    last = error;
  }
}

TEST(Flip, JudgesPicturesSmallerThanItsFilters) {
  EXPECT_NEAR(mean(flip(uniform(1, 1, kGreen), uniform(1, 1, kBlue))), 1.0, 1e-5);
  EXPECT_EQ(flip(noise(1, 5, 1), noise(1, 5, 2)).size(), 5U);
  EXPECT_EQ(flip(noise(7, 1, 1), noise(7, 1, 2), kMostPixelsPerDegree).size(), 7U);
}

/// LDR-FLIP as the paper writes it: double precision, filters in two dimensions without separation. Shares no code with
/// the library.
class PaperFlip {
 public:
  explicit PaperFlip(double pixelsPerDegree) : ppd_(pixelsPerDegree) {
    // sRGB: the primaries' and the white's chromaticities.
    const auto xyz = [](double x, double y) { return glm::dvec3(x / y, 1.0, (1.0 - x - y) / y); };
    const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
    white_ = xyz(0.31271, 0.32902);
    const glm::dvec3 scale = glm::inverse(primaries) * white_;
    xyzFromRgb_ = glm::dmat3(primaries[0] * scale[0], primaries[1] * scale[1], primaries[2] * scale[2]);
    rgbFromXyz_ = glm::inverse(xyzFromRgb_);
    largest_ = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), 0.7);
  }

  std::vector<double> map(const ImageRgba8& reference, const ImageRgba8& test) const {
    const std::vector<double> color = colorErrors(reference, test);
    const std::vector<double> feature = featureErrors(reference, test);
    std::vector<double> result;
    for (std::size_t i = 0; i < color.size(); ++i)
      result.push_back(std::pow(color[i], 1.0 - feature[i]));
    return result;
  }

 private:
  static constexpr double kPi = std::numbers::pi;

  struct Plane {
    int width, height;
    std::vector<double> values;
    double at(int x, int y) const {
      const auto row = static_cast<std::size_t>(std::clamp(y, 0, height - 1));
      return values[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
    }
  };
  struct Kernel {
    int radius;
    std::vector<double> weights;  ///< [2 radius + 1][2 radius + 1]
  };

  template <class Weight>
  static Kernel kernel(int radius, Weight weight) {
    Kernel result{radius, {}};
    for (int y = -radius; y <= radius; ++y)
      for (int x = -radius; x <= radius; ++x)
        result.weights.push_back(weight(x, y));
    return result;
  }

  /// Positive weights to the sum 1, negative ones to -1.
  static Kernel normalised(Kernel k) {
    double positive = 0.0;
    double negative = 0.0;
    for (const double w : k.weights)
      (w > 0.0 ? positive : negative) += w;
    for (double& w : k.weights)
      if (w != 0.0) w /= w > 0.0 ? positive : -negative;
    return k;
  }

  static Plane filtered(const Plane& in, const Kernel& k) {
    Plane out{in.width, in.height, {}};
    for (int y = 0; y < in.height; ++y) {
      for (int x = 0; x < in.width; ++x) {
        double sum = 0.0;
        std::size_t w = 0;
        for (int v = -k.radius; v <= k.radius; ++v)
          for (int u = -k.radius; u <= k.radius; ++u)
            sum += k.weights[w++] * in.at(x + u, y + v);
        out.values.push_back(sum);
      }
    }
    return out;
  }

  glm::dvec3 linear(const std::uint8_t* pixel) const {
    glm::dvec3 rgb;
    for (int c = 0; c < 3; ++c) {
      const double s = pixel[c] / 255.0;
      rgb[c] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
    return rgb;
  }

  std::array<Plane, 3> opponent(const ImageRgba8& image) const {
    std::array<Plane, 3> planes;
    planes.fill({static_cast<int>(image.width), static_cast<int>(image.height), {}});
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
      const glm::dvec3 xyz = xyzFromRgb_ * linear(&image.pixels[i]) / white_;
      planes[0].values.push_back(116.0 * xyz.y - 16.0);
      planes[1].values.push_back(500.0 * (xyz.x - xyz.y));
      planes[2].values.push_back(200.0 * (xyz.y - xyz.z));
    }
    return planes;
  }

  Kernel contrastSensitivity(double a1, double b1, double a2, double b2) const {
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * kPi * kPi)) * ppd_));
    return normalised(kernel(radius, [&](int x, int y) {
      const double d2 = (x * x + y * y) / (ppd_ * ppd_);
      return a1 * std::sqrt(kPi / b1) * std::exp(-kPi * kPi * d2 / b1) +
             a2 * std::sqrt(kPi / b2) * std::exp(-kPi * kPi * d2 / b2);
    }));
  }

  glm::dvec3 huntLab(const glm::dvec3& rgb) const {
    const auto f = [](double t) {
      constexpr double kDelta = 6.0 / 29.0;
      return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    };
    const glm::dvec3 xyz = xyzFromRgb_ * rgb / white_;
    const double lightness = 116.0 * f(xyz.y) - 16.0;
    const double a = 500.0 * (f(xyz.x) - f(xyz.y));
    const double b = 200.0 * (f(xyz.y) - f(xyz.z));
    return {lightness, 0.01 * lightness * a, 0.01 * lightness * b};
  }

  static double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
  }

  std::vector<glm::dvec3> seenColors(const ImageRgba8& image) const {
    const std::array<Plane, 3> planes = opponent(image);
    const Plane y = filtered(planes[0], contrastSensitivity(1.0, 0.0047, 0.0, 1e-5));
    const Plane cx = filtered(planes[1], contrastSensitivity(1.0, 0.0053, 0.0, 1e-5));
    const Plane cz = filtered(planes[2], contrastSensitivity(34.1, 0.04, 13.5, 0.025));
    std::vector<glm::dvec3> colors;
    for (std::size_t i = 0; i < y.values.size(); ++i) {
      const double yn = (y.values[i] + 16.0) / 116.0;
      const glm::dvec3 xyz = glm::dvec3(yn + cx.values[i] / 500.0, yn, yn - cz.values[i] / 200.0) * white_;
      colors.push_back(huntLab(glm::clamp(rgbFromXyz_ * xyz, 0.0, 1.0)));
    }
    return colors;
  }

  std::vector<double> colorErrors(const ImageRgba8& reference, const ImageRgba8& test) const {
    const std::vector<glm::dvec3> a = seenColors(reference);
    const std::vector<glm::dvec3> b = seenColors(test);
    const double knee = 0.4 * largest_;
    std::vector<double> errors;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double e = std::pow(hyab(a[i], b[i]), 0.7);
      errors.push_back(e < knee ? 0.95 / knee * e : 0.95 + (e - knee) / (largest_ - knee) * 0.05);
    }
    return errors;
  }

  /// Length of the gradient at each pixel; of edges or of points.
  std::vector<double> strength(const Plane& luminance, bool points) const {
    const double sd = 0.5 * 0.082 * ppd_;
    const int radius = static_cast<int>(std::ceil(3.0 * sd));
    const auto weight = [&](int x, int y) {
      const double g = std::exp(-(x * x + y * y) / (2.0 * sd * sd));
      return points ? (x * x / (sd * sd) - 1.0) * g : -x * g;
    };
    const Plane alongX = filtered(luminance, normalised(kernel(radius, weight)));
    const Plane alongY = filtered(luminance, normalised(kernel(radius, [&](int x, int y) { return weight(y, x); })));
    std::vector<double> result;
    for (std::size_t i = 0; i < alongX.values.size(); ++i)
      result.push_back(std::hypot(alongX.values[i], alongY.values[i]));
    return result;
  }

  std::vector<double> featureErrors(const ImageRgba8& reference, const ImageRgba8& test) const {
    const auto luminance = [&](const ImageRgba8& image) {
      Plane plane = opponent(image)[0];
      for (double& y : plane.values)
        y = (y + 16.0) / 116.0;
      return plane;
    };
    const Plane a = luminance(reference);
    const Plane b = luminance(test);
    std::vector<double> errors(a.values.size());
    for (const bool points : {false, true}) {
      const std::vector<double> sa = strength(a, points);
      const std::vector<double> sb = strength(b, points);
      for (std::size_t i = 0; i < errors.size(); ++i)
        errors[i] = std::max(errors[i], std::sqrt(std::abs(sa[i] - sb[i]) / std::sqrt(2.0)));
    }
    return errors;
  }

  double ppd_;
  glm::dvec3 white_{};
  glm::dmat3 xyzFromRgb_{};
  glm::dmat3 rgbFromXyz_{};
  double largest_ = 0.0;
};

TEST(Flip, AgreesWithThePapersEquations) {
  for (const double pixelsPerDegree : {kDefaultPixelsPerDegree, 20.0, 130.0}) {
    const PaperFlip paper(pixelsPerDegree);
    std::size_t number = 0;
    for (const auto& [a, b] : pairs(40, 30)) {
      const std::vector<float> map = flip(a, b, pixelsPerDegree);
      const std::vector<double> expected = paper.map(a, b);
      ASSERT_EQ(map.size(), expected.size());
      double largest = 0.0;
      double sum = 0.0;
      for (std::size_t i = 0; i < map.size(); ++i) {
        largest = std::max(largest, std::abs(static_cast<double>(map[i]) - expected[i]));
        sum += expected[i];
      }
      EXPECT_LT(largest, 1e-5) << "pair " << number << " at " << pixelsPerDegree;
      EXPECT_NEAR(mean(map), sum / static_cast<double>(map.size()), 1e-6) << "pair " << number;
      ++number;
    }
  }
}

TEST(FlipMean, IsTheMapsMean) {
  EXPECT_EQ(mean({}), 0.0);
  EXPECT_EQ(mean({0.25F}), 0.25);
  EXPECT_DOUBLE_EQ(mean({0.0F, 0.5F, 1.0F, 0.5F}), 0.5);
}

TEST(ErrorPicture, RunsFromNearlyBlackToPaleYellow) {
  const ImageRgba8 picture = errorPicture({0.0F, 1.0F}, 2, 1);
  ASSERT_EQ(picture.pixels.size(), 8U);
  EXPECT_LE(picture.pixels[0] + picture.pixels[1] + picture.pixels[2], 8);
  EXPECT_GE(picture.pixels[4], 240);
  EXPECT_GE(picture.pixels[5], 240);
  EXPECT_LT(picture.pixels[6], 220);
  EXPECT_GT(picture.pixels[6], 150);
}

TEST(ErrorPicture, IsOpaque) {
  const ImageRgba8 picture = errorPicture({0.0F, 0.3F, 0.6F, 1.0F, 0.1F, 0.2F}, 3, 2);
  EXPECT_EQ(picture.width, 3U);
  EXPECT_EQ(picture.height, 2U);
  ASSERT_EQ(picture.pixels.size(), 24U);
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4)
    EXPECT_EQ(picture.pixels[i], 255);
}

TEST(ErrorPicture, GetsBrighterAsTheErrorGrows) {
  std::vector<float> ramp;
  for (int i = 0; i <= 256; ++i)
    ramp.push_back(static_cast<float>(i) / 256.0F);
  const ImageRgba8 picture = errorPicture(ramp, static_cast<std::uint32_t>(ramp.size()), 1);
  const auto luminance = [&](std::size_t i) {
    const std::uint8_t* p = &picture.pixels[4 * i];
    return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
  };
  for (std::size_t i = 1; i < ramp.size(); ++i)
    EXPECT_GE(luminance(i), luminance(i - 1)) << i;
  for (std::size_t i = 4; i < ramp.size(); ++i)
    EXPECT_GT(luminance(i), luminance(i - 4)) << i;
}

TEST(ErrorPicture, ShowsValuesOutsideAsTheEnds) {
  EXPECT_EQ(errorPicture({-0.5F, 1.5F}, 2, 1).pixels, errorPicture({0.0F, 1.0F}, 2, 1).pixels);
}

class Ffmpeg : public testing::Test {
 protected:
  void SetUp() override {
    const std::optional<std::filesystem::path> found = test::findProgram("ffmpeg");
    if (!found) GTEST_SKIP() << "no ffmpeg in PATH";
    program_ = *found;
  }

  /// The number behind `label` in what a filter says about two pictures; NaN with a failure if there is none.
  double says(const std::string& filter, const std::string& label, const ImageRgba8& a, const ImageRgba8& b) const {
    const test::TemporaryFolder folder;
    asset::savePng(a, folder / "a.png");
    asset::savePng(b, folder / "b.png");
    // Its plain code: the vector code of version 5.1 sums up too much where a row has 4 n + 1 windows (123 pixels).
    const std::string graph = "[0]format=gbrp[a];[1]format=gbrp[b];[a][b]" + filter;  // planes, no conversion
    const test::ProgramResult result =
        test::runProgram(program_, {"-cpuflags", "0", "-hide_banner", "-nostdin", "-i", (folder / "a.png").string(),
                                    "-i", (folder / "b.png").string(), "-lavfi", graph, "-f", "null", "-"});
    const std::size_t at = result.standardError.rfind(label);
    if (result.exitCode != 0 || at == std::string::npos) {
      ADD_FAILURE() << "ffmpeg says no " << label << "\n" << result.standardError;
      return std::numeric_limits<double>::quiet_NaN();
    }
    return std::strtod(result.standardError.c_str() + at + label.size(), nullptr);
  }

  /// Sizes that are multiples of the windows' stride and sizes that are not.
  static std::vector<Pair> pictures() {
    std::vector<Pair> result;
    for (const auto& [width, height] : {std::pair{160U, 96U}, {123U, 77U}, {50U, 131U}}) {
      const ImageRgba8 scene = structure(width, height);
      result.emplace_back(scene, roughened(scene, 20, 1));
      result.emplace_back(scene, blurred(scene, 2));
      result.emplace_back(scene, saturated(width, height, 3));
    }
    return result;
  }

 private:
  std::filesystem::path program_;
};

TEST_F(Ffmpeg, HasTheSamePsnr) {
  for (const auto& [a, b] : pictures())
    EXPECT_NEAR(psnr(a, b), says("psnr", "average:", a, b), 1e-5);
}

TEST_F(Ffmpeg, HasTheSameSsim) {
  for (const auto& [a, b] : pictures())
    EXPECT_NEAR(ssim(a, b), says("ssim", "All:", a, b), 1e-5);
}

TEST(Flip, StripsHaveTheValuesOfTheWholePicture) {
  Random random(11);
  ImageRgba8 a{40, 300, std::vector<std::uint8_t>(std::size_t{4} * 40 * 300)};
  ImageRgba8 b = a;
  for (std::uint8_t& value : a.pixels)
    value = static_cast<std::uint8_t>(random.below(256));
  for (std::uint8_t& value : b.pixels)
    value = static_cast<std::uint8_t>(random.below(256));
  for (const double pixelsPerDegree : {20.0, kDefaultPixelsPerDegree, 300.0}) {
    std::vector<float> joined;
    flipStrips(a, b, pixelsPerDegree,
               [&](std::span<const float> values) { joined.insert(joined.end(), values.begin(), values.end()); });
    EXPECT_EQ(joined, flipMap(FlipImage(a, pixelsPerDegree), FlipImage(b, pixelsPerDegree))) << pixelsPerDegree;
  }
}

}  // namespace
}  // namespace jalousie::compare
