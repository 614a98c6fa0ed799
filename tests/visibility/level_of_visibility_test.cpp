// Laws and known numbers of the DCT and the level of visibility (thesis 3.5).
#include "visibility/level_of_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/random.h"

namespace jalousie::visibility {
namespace {

struct OwnedBlock {
  std::uint32_t width, height;
  std::vector<float> values;
  Block view() const { return {width, height, values}; }
  float& at(std::uint32_t i, std::uint32_t j) { return values[std::size_t{j} * width + i]; }
};

OwnedBlock constantBlock(std::uint32_t width, std::uint32_t height, float value) {
  return {width, height, std::vector<float>(std::size_t{width} * height, value)};
}

OwnedBlock randomBlock(std::uint32_t width, std::uint32_t height, std::uint64_t seed) {
  OwnedBlock block = constantBlock(width, height, 0.0F);
  Random random(seed);
  for (float& value : block.values)
    value = random.uniform(-128.0F, 128.0F);
  return block;
}

OwnedBlock transposed(const OwnedBlock& block) {
  OwnedBlock result = constantBlock(block.height, block.width, 0.0F);
  for (std::uint32_t j = 0; j < block.height; ++j)
    for (std::uint32_t i = 0; i < block.width; ++i)
      result.at(j, i) = block.values[std::size_t{j} * block.width + i];
  return result;
}

OwnedBlock mirrored(OwnedBlock block) {
  for (std::uint32_t j = 0; j < block.height; ++j)
    std::reverse(block.values.begin() + static_cast<std::ptrdiff_t>(j * block.width),
                 block.values.begin() + static_cast<std::ptrdiff_t>((j + 1) * block.width));
  return block;
}

/// LV in the thesis' unit of a 8x8 pattern of covered (1) and open (0) texels, values +-128.
float lvOfPattern(const OwnedBlock& covered) {
  OwnedBlock shifted = covered;
  for (float& value : shifted.values)
    value = (value - 0.5F) * 256.0F;
  return levelOfVisibility(lowCoefficients(shifted.view()));
}

/// The same from 8-bit opacities: 0..255 shifted by 128, as the thesis' own figures are.
float lvOf8BitPattern(const OwnedBlock& covered) {
  OwnedBlock shifted = covered;
  for (float& value : shifted.values)
    value = value * 255.0F - 128.0F;
  return levelOfVisibility(lowCoefficients(shifted.view()));
}

OwnedBlock coveredExcept(std::initializer_list<std::array<std::uint32_t, 4>> holes, std::uint32_t side = 8) {
  OwnedBlock block = constantBlock(side, side, 1.0F);
  for (const auto& [x, y, w, h] : holes)
    for (std::uint32_t j = y; j < y + h; ++j)
      for (std::uint32_t i = x; i < x + w; ++i)
        block.at(i, j) = 0.0F;
  return block;
}

TEST(LevelOfVisibility, CoveredAndOpenBlocksOf8x8ScoreTheThesisNumbers) {
  EXPECT_NEAR(lvOfPattern(constantBlock(8, 8, 1.0F)), 1024.0F, 1e-2F);
  EXPECT_NEAR(lvOfPattern(constantBlock(8, 8, 0.0F)), -1024.0F, 1e-2F);
}

TEST(LevelOfVisibility, NormalisedValueDoesNotDependOnBlockSize) {
  for (std::uint32_t width = 1; width <= 16; ++width) {
    for (std::uint32_t height = 1; height <= 16; ++height) {
      const OwnedBlock covered = constantBlock(width, height, 128.0F);
      const OwnedBlock open = constantBlock(width, height, -128.0F);
      const float root = std::sqrt(static_cast<float>(width * height));
      EXPECT_NEAR(levelOfVisibility(lowCoefficients(covered.view())), 128.0F * root, 2e-2F);
      EXPECT_NEAR(normalisedLv(levelOfVisibility(lowCoefficients(covered.view())), 256.0F, width, height), 1.0F, 1e-5F);
      EXPECT_NEAR(normalisedLv(levelOfVisibility(lowCoefficients(open.view())), 256.0F, width, height), -1.0F, 1e-5F);
      EXPECT_NEAR(levelOfVisibilityOfOpacity(constantBlock(width, height, 1.0F).view()), 1.0F, 1e-5F);
    }
  }
}

/// LV is concave in the block (F00 minus magnitudes), so for each choice of the three signs it is linear and minimal
/// where every texel takes the end its weight asks for. The least of the eight minima is the minimum over all blocks.
double trueMinimum(std::uint32_t side) {
  double minimum = 0.0;
  for (int signs = 0; signs < 8; ++signs) {
    OwnedBlock unit = constantBlock(side, side, 0.0F);
    double sum = 0.0;
    for (std::uint32_t j = 0; j < side; ++j) {
      for (std::uint32_t i = 0; i < side; ++i) {
        unit.at(i, j) = 1.0F;
        const std::vector<double> f = dct2d(unit.view());
        unit.at(i, j) = 0.0F;
        const double weight = f[0] - ((signs & 1) != 0 ? -f[1] : f[1]) - ((signs & 2) != 0 ? -f[side] : f[side]) -
                              ((signs & 4) != 0 ? -f[side + 1] : f[side + 1]);
        sum -= 128.0 * std::abs(weight);
      }
    }
    minimum = std::min(minimum, sum);
  }
  return minimum;
}

TEST(LevelOfVisibility, MinimumLiesBelowMinusOne) {
  EXPECT_NEAR(trueMinimum(8), -1872.2, 0.05);
  EXPECT_NEAR(trueMinimum(8) / 1024.0, -1.83, 0.005);
  EXPECT_NEAR(trueMinimum(16) / 2048.0, -1.82, 0.005);
}

TEST(LevelOfVisibility, SymmetricHolesFoolTheThesisMeasure) {
  OwnedBlock pinholes = constantBlock(8, 8, 1.0F);
  for (std::uint32_t j = 0; j < 8; j += 2)
    for (std::uint32_t i = 0; i < 8; i += 2)
      pinholes.at(i, j) = 0.0F;
  EXPECT_NEAR(lvOf8BitPattern(coveredExcept({{2, 2, 4, 4}})), 506.0F, 0.5F);
  EXPECT_NEAR(lvOf8BitPattern(pinholes), 306.0F, 0.5F);
  EXPECT_NEAR(lvOf8BitPattern(coveredExcept({{0, 0, 4, 4}})), -837.0F, 0.5F);
}

TEST(LevelOfVisibility, OpeningsOf16x16MatchThePublishedTable) {
  const auto lvn = [](const OwnedBlock& block) { return levelOfVisibilityOfOpacity(block.view()); };
  EXPECT_NEAR(lvn(coveredExcept({{4, 4, 8, 8}}, 16)), 0.50F, 0.005F);
  EXPECT_NEAR(lvn(coveredExcept({{0, 0, 8, 8}}, 16)), -0.81F, 0.01F);
  EXPECT_NEAR(lvn(coveredExcept({{6, 0, 4, 16}}, 16)), 0.50F, 0.005F);
}

TEST(Dct, KeepsEnergy) {
  for (const auto& [width, height] : {std::array{8U, 8U}, {16U, 5U}, {3U, 11U}, {1U, 7U}}) {
    const OwnedBlock block = randomBlock(width, height, width * 31 + height);
    const std::vector<double> f = dct2d(block.view());
    const double before = std::inner_product(block.values.begin(), block.values.end(), block.values.begin(), 0.0);
    const double after = std::inner_product(f.begin(), f.end(), f.begin(), 0.0);
    EXPECT_NEAR(after / before, 1.0, 1e-6);
  }
}

TEST(Dct, ConstantBlockHasOnlyItsMean) {
  const std::vector<double> f = dct2d(constantBlock(12, 7, 3.0F).view());
  EXPECT_NEAR(f[0], 3.0 * std::sqrt(84.0), 1e-9);
  for (std::size_t k = 1; k < f.size(); ++k)
    EXPECT_NEAR(f[k], 0.0, 1e-9);
}

TEST(Dct, TransposingSwapsFrequencies) {
  const OwnedBlock block = randomBlock(10, 6, 5);
  const LowCoefficients a = lowCoefficients(block.view());
  const LowCoefficients b = lowCoefficients(transposed(block).view());
  EXPECT_NEAR(a.f10, b.f01, 1e-2F);
  EXPECT_NEAR(a.f01, b.f10, 1e-2F);
  EXPECT_NEAR(a.f11, b.f11, 1e-2F);
}

TEST(Dct, MirroringKeepsMagnitudes) {
  const OwnedBlock block = randomBlock(16, 9, 6);
  const std::vector<double> a = dct2d(block.view());
  const std::vector<double> b = dct2d(mirrored(block).view());
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_NEAR(std::abs(a[k]), std::abs(b[k]), 1e-3);
}

TEST(Dct, SeparableSumsAgreeWithTheDefinition) {
  for (std::uint32_t width = 1; width <= 16; ++width) {
    for (std::uint32_t height = 1; height <= 16; ++height) {
      const OwnedBlock block = randomBlock(width, height, width * 100 + height);
      const std::vector<double> f = dct2d(block.view());
      const LowCoefficients low = lowCoefficients(block.view());
      EXPECT_NEAR(low.f00, f[0], 5e-3);
      EXPECT_NEAR(low.f10, width > 1 ? f[1] : 0.0, 5e-3);
      EXPECT_NEAR(low.f01, height > 1 ? f[width] : 0.0, 5e-3);
      EXPECT_NEAR(low.f11, width > 1 && height > 1 ? f[width + 1] : 0.0, 5e-3);
    }
  }
}

TEST(LevelOfVisibility, TinyBlocksCountByTheirMeanAlone) {
  OwnedBlock half = constantBlock(3, 2, 1.0F);
  half.at(0, 0) = half.at(0, 1) = half.at(1, 0) = 0.0F;
  EXPECT_NEAR(levelOfVisibilityOfOpacity(half.view()), 0.0F, 1e-6F);
}

}  // namespace
}  // namespace jalousie::visibility
