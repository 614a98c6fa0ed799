// DCT-II and the level of visibility (thesis Eq. 3.2, 3.3, with the corrected factors).
#include "visibility/level_of_visibility.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "shared/limits.h"

namespace jalousie::visibility {
namespace {

double cosine(std::uint32_t frequency, std::uint32_t index, std::uint32_t count) {
  // std::cos(pi/2) is not exactly 0. The cosine must be, or a block that is one texel wide would have a spectrum.
  if (frequency == 1 && 2 * index + 1 == count) return 0.0;
  return std::cos(std::numbers::pi * frequency * (2.0 * index + 1.0) / (2.0 * count));
}

double normalisation(std::uint32_t frequency, std::uint32_t count) {
  return std::sqrt((frequency == 0 ? 1.0 : 2.0) / count);
}

}  // namespace

double dctCoefficient(const Block& block, std::uint32_t u, std::uint32_t v) {
  double sum = 0.0;
  for (std::uint32_t j = 0; j < block.height; ++j)
    for (std::uint32_t i = 0; i < block.width; ++i)
      sum += static_cast<double>(block.values[std::size_t{j} * block.width + i]) * cosine(u, i, block.width) *
             cosine(v, j, block.height);
  return sum * normalisation(u, block.width) * normalisation(v, block.height);
}

std::array<float, 256> cosineTable() {
  std::array<float, 256> table = {};
  for (std::uint32_t count = 1; count <= gpu::kMaxBlockSide; ++count)
    for (std::uint32_t i = 0; i < count; ++i)
      table[gpu::kMaxBlockSide * (count - 1) + i] = static_cast<float>(cosine(1, i, count));
  return table;
}

std::vector<double> dct2d(const Block& block) {
  std::vector<double> coefficients(std::size_t{block.width} * block.height);
  for (std::uint32_t v = 0; v < block.height; ++v)
    for (std::uint32_t u = 0; u < block.width; ++u)
      coefficients[std::size_t{v} * block.width + u] = dctCoefficient(block, u, v);
  return coefficients;
}

LowCoefficients lowCoefficients(const Block& block) {
  JAL_CHECK(std::min(block.width, block.height) >= 1U);
  JAL_CHECK(std::max(block.width, block.height) <= gpu::kMaxBlockSide);
  static const std::array<float, 256> kCosines = cosineTable();
  const float* cosinesX = &kCosines[gpu::kMaxBlockSide * (block.width - 1)];
  const float* cosinesY = &kCosines[gpu::kMaxBlockSide * (block.height - 1)];
  LowCoefficients sums;
  for (std::uint32_t j = 0; j < block.height; ++j) {
    float rowSum = 0.0F;
    float rowCosine = 0.0F;
    for (std::uint32_t i = 0; i < block.width; ++i) {
      const float f = block.values[std::size_t{j} * block.width + i];
      rowSum += f;
      rowCosine += f * cosinesX[i];
    }
    sums.f00 += rowSum;
    sums.f10 += rowCosine;
    sums.f01 += rowSum * cosinesY[j];
    sums.f11 += rowCosine * cosinesY[j];
  }
  const float scale = 1.0F / std::sqrt(static_cast<float>(block.width * block.height));
  const auto root2 = std::numbers::sqrt2_v<float>;
  return {scale * sums.f00, scale * root2 * sums.f10, scale * root2 * sums.f01, scale * 2.0F * sums.f11};
}

float levelOfVisibility(const LowCoefficients& c) {
  return c.f00 - (std::abs(c.f10) + std::abs(c.f01) + std::abs(c.f11));
}

float normalisedLv(float lv, float range, std::uint32_t width, std::uint32_t height) {
  return lv / (0.5F * range * std::sqrt(static_cast<float>(width * height)));
}

float levelOfVisibilityOfOpacity(const Block& opacity) {
  std::vector<float> shifted(opacity.values.begin(), opacity.values.end());
  for (float& value : shifted)
    value -= 0.5F;
  LowCoefficients low = lowCoefficients({opacity.width, opacity.height, shifted});
  if (std::max(opacity.width, opacity.height) < gpu::kMinSpectrumSide) low.f10 = low.f01 = low.f11 = 0.0F;
  return normalisedLv(levelOfVisibility(low), 1.0F, opacity.width, opacity.height);
}

}  // namespace jalousie::visibility
