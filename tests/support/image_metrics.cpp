// Plain sums in double precision.
#include "support/image_metrics.h"

#include <cmath>
#include <limits>

#include "core/check.h"

namespace jalousie::test {
namespace {

constexpr std::uint32_t kWindow = 8;
constexpr std::uint32_t kStride = 4;

double luma(const ImageRgba8& image, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = &image.pixels[image.offset(x, y)];
  return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
}

double windowSimilarity(const ImageRgba8& a, const ImageRgba8& b, std::uint32_t x0, std::uint32_t y0) {
  double sumA = 0.0, sumB = 0.0, sumAA = 0.0, sumBB = 0.0, sumAB = 0.0;
  for (std::uint32_t y = y0; y < y0 + kWindow; ++y) {
    for (std::uint32_t x = x0; x < x0 + kWindow; ++x) {
      const double u = luma(a, x, y);
      const double v = luma(b, x, y);
      sumA += u;
      sumB += v;
      sumAA += u * u;
      sumBB += v * v;
      sumAB += u * v;
    }
  }
  constexpr double kCount = kWindow * kWindow;
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255;
  constexpr double kC2 = 0.03 * 255 * 0.03 * 255;
  const double meanA = sumA / kCount;
  const double meanB = sumB / kCount;
  const double varianceA = sumAA / kCount - meanA * meanA;
  const double varianceB = sumBB / kCount - meanB * meanB;
  const double covariance = sumAB / kCount - meanA * meanB;
  return (2 * meanA * meanB + kC1) * (2 * covariance + kC2) /
         ((meanA * meanA + meanB * meanB + kC1) * (varianceA + varianceB + kC2));
}

}  // namespace

double psnr(const ImageRgba8& a, const ImageRgba8& b) {
  JAL_CHECK(a.width == b.width);
  JAL_CHECK(a.height == b.height);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    if (i % 4 != 3) sum += std::pow(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]), 2.0);
  if (sum <= 0.0) return std::numeric_limits<double>::infinity();
  const double count = 3.0 * a.width * a.height;
  return 10.0 * std::log10(255.0 * 255.0 * count / sum);
}

double ssim(const ImageRgba8& a, const ImageRgba8& b) {
  JAL_CHECK(a.width == b.width);
  JAL_CHECK(a.height == b.height);
  JAL_CHECK(a.width >= kWindow);
  JAL_CHECK(a.height >= kWindow);
  double sum = 0.0;
  std::size_t windows = 0;
  for (std::uint32_t y = 0; y + kWindow <= a.height; y += kStride)
    for (std::uint32_t x = 0; x + kWindow <= a.width; x += kStride, ++windows)
      sum += windowSimilarity(a, b, x, y);
  return sum / static_cast<double>(windows);
}

}  // namespace jalousie::test
