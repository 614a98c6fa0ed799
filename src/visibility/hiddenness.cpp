// Measures of one block, plainly.
#include "visibility/hiddenness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "policy/traits.h"
#include "shared/limits.h"

namespace jalousie::visibility {
namespace {

double cosine(std::uint32_t frequency, std::uint32_t index, std::uint32_t count) {
  return std::cos(std::numbers::pi * frequency * (2.0 * index + 1.0) / (2.0 * count));
}

double coefficient(const Block& block, std::uint32_t u, std::uint32_t v) {
  double sum = 0.0;
  for (std::uint32_t j = 0; j < block.height; ++j)
    for (std::uint32_t i = 0; i < block.width; ++i)
      sum += block.values[std::size_t{j} * block.width + i] * cosine(u, i, block.width) * cosine(v, j, block.height);
  const double a = std::sqrt((u == 0 ? 1.0 : 2.0) / block.width);
  const double b = std::sqrt((v == 0 ? 1.0 : 2.0) / block.height);
  return a * b * sum;
}

}  // namespace

float openShare(const Block& block) {
  float sum = 0.0F;
  for (const float value : block.values)
    sum += value;
  return sum / static_cast<float>(block.values.size());
}

float spectralFineness(const Block& block) {
  const double open = openShare(block);
  const double variance = open * (1.0 - open);
  if (variance <= 1e-9) return 0.0F;
  double low = 0.0;
  for (std::uint32_t v = 0; v <= std::min(2U, block.height - 1); ++v)
    for (std::uint32_t u = 0; u <= std::min(2U, block.width - 1); ++u)
      if (u + v > 0) low += std::pow(coefficient(block, u, v), 2.0);
  low /= static_cast<double>(block.width) * block.height;
  return static_cast<float>(std::clamp(1.0 - low / variance, 0.0, 1.0));
}

float meanOpenChord(const Block& block) {
  float different = 0.0F;
  std::uint32_t pairs = 0;
  for (std::uint32_t j = 0; j < block.height; ++j) {
    for (std::uint32_t i = 0; i < block.width; ++i) {
      const float value = block.values[std::size_t{j} * block.width + i];
      if (i + 1 < block.width) {
        different += std::abs(value - block.values[std::size_t{j} * block.width + i + 1]);
        ++pairs;
      }
      if (j + 1 < block.height) {
        different += std::abs(value - block.values[std::size_t{j + 1} * block.width + i]);
        ++pairs;
      }
    }
  }
  const float open = openShare(block);
  if (open <= 0.0F) return 0.0F;
  if (different <= 0.0F || pairs == 0) return std::numeric_limits<float>::infinity();
  return 2.0F * open * static_cast<float>(pairs) / different;
}

float blockLv(gpu::uint traits, const Block& opacity, float texelPixels) {
  if (has(traits, gpu::kTraitLvThesis)) return levelOfVisibilityOfOpacity(opacity);
  std::vector<float> values(opacity.values.begin(), opacity.values.end());
  for (float& value : values)
    value = 1.0F - value;
  const Block transmittance{opacity.width, opacity.height, values};
  const float covered = 1.0F - openShare(transmittance);
  float h = 0.0F;
  if (has(traits, gpu::kTraitLvCoverage | gpu::kTraitLvPixels)) h = covered;
  if (has(traits, gpu::kTraitLvSpectral)) h = covered * spectralFineness(transmittance);
  if (has(traits, gpu::kTraitLvChord))
    h = covered / (1.0F + meanOpenChord(transmittance) * texelPixels / gpu::kChordPixels);
  return 2.0F * h - 1.0F;
}

}  // namespace jalousie::visibility
