// PSNR and SSIM: integer sums per window, double precision across windows.
#include "compare/image_error.h"

#include <cmath>
#include <limits>

#include "core/check.h"

namespace jalousie::compare {
namespace {

constexpr std::uint32_t kStride = 4;

/// Similarity of one channel in one window.
double windowSimilarity(const ImageRgba8& a, const ImageRgba8& b, std::uint32_t x0, std::uint32_t y0,
                        std::size_t channel) {
  std::int64_t sumA = 0, sumB = 0, sumSquares = 0, sumAB = 0;
  for (std::uint32_t y = y0; y < y0 + kLeastSsimSide; ++y) {
    for (std::uint32_t x = x0; x < x0 + kLeastSsimSide; ++x) {
      const std::int64_t u = a.pixels[a.offset(x, y) + channel];
      const std::int64_t v = b.pixels[b.offset(x, y) + channel];
      sumA += u;
      sumB += v;
      sumSquares += u * u + v * v;
      sumAB += u * v;
    }
  }
  // Squared means are scaled by n^2, variances by n (n - 1), so that the sums stay integers.
  constexpr double kCount = kLeastSsimSide * kLeastSsimSide;
  constexpr double kC1 = 0.01 * 0.01 * 255 * 255 * kCount * kCount;
  constexpr double kC2 = 0.03 * 0.03 * 255 * 255 * kCount * (kCount - 1);
  const auto meanA = static_cast<double>(sumA);
  const auto meanB = static_cast<double>(sumB);
  const double variances = static_cast<double>(sumSquares) * kCount - meanA * meanA - meanB * meanB;
  const double covariance = static_cast<double>(sumAB) * kCount - meanA * meanB;
  return (2 * meanA * meanB + kC1) * (2 * covariance + kC2) /
         ((meanA * meanA + meanB * meanB + kC1) * (variances + kC2));
}

}  // namespace

double psnr(const ImageRgba8& reference, const ImageRgba8& test) {
  JAL_CHECK(reference.width == test.width);
  JAL_CHECK(reference.height == test.height);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    const int difference = static_cast<int>(reference.pixels[i]) - static_cast<int>(test.pixels[i]);
    if (i % 4 != 3) sum += static_cast<std::uint64_t>(difference * difference);
  }
  if (sum == 0) return std::numeric_limits<double>::infinity();
  const double count = 3.0 * reference.width * reference.height;
  return 10.0 * std::log10(255.0 * 255.0 * count / static_cast<double>(sum));
}

double ssim(const ImageRgba8& reference, const ImageRgba8& test) {
  JAL_CHECK(reference.width == test.width);
  JAL_CHECK(reference.height == test.height);
  JAL_CHECK(reference.width >= kLeastSsimSide);
  JAL_CHECK(reference.height >= kLeastSsimSide);
  double sum = 0.0;
  std::size_t windows = 0;
  for (std::uint32_t y = 0; y + kLeastSsimSide <= reference.height; y += kStride)
    for (std::uint32_t x = 0; x + kLeastSsimSide <= reference.width; x += kStride)
      for (std::size_t channel = 0; channel < 3; ++channel, ++windows)
        sum += windowSimilarity(reference, test, x, y, channel);
  return sum / static_cast<double>(windows);
}

std::optional<double> meanOver(const std::vector<float>& map, const std::vector<std::uint8_t>& covered) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    if (covered[i] == 0) continue;
    sum += static_cast<double>(map[i]);
    ++count;
  }
  return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

double mean(const std::vector<float>& map) {
  double sum = 0.0;
  for (const float value : map)
    sum += value;
  return map.empty() ? 0.0 : sum / static_cast<double>(map.size());
}

}  // namespace jalousie::compare
