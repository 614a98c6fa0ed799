// Measures of hiddenness on patterns worked out by hand, and the order that they must keep.
#include "visibility/hiddenness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/random.h"
#include "policy/lv_measure.h"
#include "visibility/item_buffer.h"
#include "visibility/lod_policy.h"

namespace jalousie::visibility {
namespace {

constexpr std::uint32_t kSide = 16;

/// A quarter of a 16x16 block is open: holes x holes squares, as large as that makes them, moved by (dx, dy).
std::vector<float> squareHoles(std::uint32_t holes, std::uint32_t dx, std::uint32_t dy) {
  const std::uint32_t cell = kSide / holes;
  const std::uint32_t hole = cell / 2;
  std::vector<float> values(kSide * kSide);
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x)
      values[std::size_t{(y + dy) % kSide} * kSide + (x + dx) % kSide] =
          x % cell < hole && y % cell < hole ? 1.0F : 0.0F;
  return values;
}

/// Vertical slots, a quarter open.
std::vector<float> slots(std::uint32_t count) {
  const std::uint32_t cell = kSide / count;
  std::vector<float> values(kSide * kSide);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = i % kSide % cell < cell / 4 ? 1.0F : 0.0F;
  return values;
}

Block block(const std::vector<float>& values) {
  return {kSide, kSide, values};
}

float hiddenOf(LvMeasure measure, const std::vector<float>& transmittance) {
  std::vector<float> opacity = transmittance;
  for (float& value : opacity)
    value = 1.0F - value;
  return 0.5F * (blockLv(traitsOf(measure), {kSide, kSide, opacity}, 1.0F) + 1.0F);
}

TEST(Hiddenness, FinenessOfTheComputedPatterns) {
  EXPECT_NEAR(spectralFineness(block(squareHoles(1, 4, 4))), 0.23F, 0.01F);  // one 8x8 hole, centred
  EXPECT_NEAR(spectralFineness(block(squareHoles(1, 0, 0))), 0.24F, 0.01F);  // in the corner
  EXPECT_NEAR(spectralFineness(block(squareHoles(2, 0, 0))), 0.90F, 0.01F);  // four 4x4
  EXPECT_NEAR(spectralFineness(block(squareHoles(2, 2, 2))), 1.00F, 0.01F);  // shifted
  EXPECT_NEAR(spectralFineness(block(squareHoles(4, 0, 0))), 0.98F, 0.01F);
  EXPECT_NEAR(spectralFineness(block(squareHoles(8, 0, 0))), 0.99F, 0.01F);
  EXPECT_NEAR(spectralFineness(block(slots(2))), 0.90F, 0.02F);
  EXPECT_NEAR(spectralFineness(block(slots(4))), 0.98F, 0.02F);
}

TEST(Hiddenness, OpenAndCoveredBlocksHaveNoFineness) {
  EXPECT_EQ(spectralFineness(block(std::vector<float>(256, 1.0F))), 0.0F);
  EXPECT_EQ(spectralFineness(block(std::vector<float>(256, 0.0F))), 0.0F);
  EXPECT_EQ(meanOpenChord(block(std::vector<float>(256, 0.0F))), 0.0F);
  EXPECT_TRUE(std::isinf(meanOpenChord(block(std::vector<float>(256, 1.0F)))));
}

TEST(Hiddenness, ChordHalvesAsHolesHalve) {
  float last = 100.0F;
  for (const std::uint32_t holes : {1U, 2U, 4U, 8U}) {
    const float chord = meanOpenChord(block(squareHoles(holes, 0, 0)));
    EXPECT_LT(chord, 0.7F * last) << holes;
    last = chord;
  }
  EXPECT_NEAR(meanOpenChord(block(squareHoles(2, 2, 2))), 3.75F, 0.05F);  // 4 but for the border
}

TEST(Hiddenness, FinerHolesAreNeverLessHiddenExceptToTheThesis) {
  // The chord keeps the order strictly; the fineness saturates and wavers by a fiftieth.
  for (const auto& [measure, waver] : {std::pair{LvMeasure::kChord, 0.0F}, {LvMeasure::kSpectral, 0.02F}}) {
    float last = 0.0F;
    for (const std::uint32_t holes : {1U, 2U, 4U, 8U}) {
      float least = 1.0F;
      float most = 0.0F;
      for (std::uint32_t shift = 0; shift < kSide / holes; ++shift) {
        const float h = hiddenOf(measure, squareHoles(holes, shift, (shift * 3) % kSide));
        least = std::min(least, h);
        most = std::max(most, h);
      }
      EXPECT_GE(least, last - waver) << rowOf(measure).name << ", " << holes << " holes a side";
      last = most;
    }
  }
  // One large hole in the middle counts as more hidden than 64 pinholes: what the thesis' measure gets wrong.
  EXPECT_GT(hiddenOf(LvMeasure::kThesis, squareHoles(1, 4, 4)), hiddenOf(LvMeasure::kThesis, squareHoles(8, 0, 0)));
}

TEST(Hiddenness, CountedPixelsCannotTellHowAnOpeningIsDivided) {
  // The default's order holds with equality: at equal cover it is the same for every pattern and every shift of it.
  std::vector<float> all;
  for (const std::uint32_t holes : {1U, 2U, 4U, 8U}) {
    for (std::uint32_t shift = 0; shift < kSide / holes; ++shift) {
      std::vector<std::uint32_t> items;
      for (const float open : squareHoles(holes, shift, (shift * 3) % kSide))
        items.push_back(open > 0.0F ? 1 : 2);
      all.push_back(pixelsLv(static_cast<float>(countPixels(items, 2)[0]), kSide * kSide));
    }
  }
  for (const float lv : all)
    EXPECT_EQ(lv, all.front());
  EXPECT_GT(pixelsLv(63.0F, kSide * kSide), all.front()) << "a pixel less is more hidden";
}

TEST(Hiddenness, MirroringAndTransposingChangeNothing) {
  Random random(4);
  std::vector<float> values(kSide * kSide);
  for (float& value : values)
    value = random.below(3) == 0 ? random.uniform() : 0.0F;
  std::vector<float> mirrored(values.size());
  std::vector<float> transposed(values.size());
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      mirrored[y * kSide + kSide - 1 - x] = values[y * kSide + x];
      transposed[x * kSide + y] = values[y * kSide + x];
    }
  for (const LvMeasureRow& row : lvMeasureTable()) {
    EXPECT_NEAR(hiddenOf(row.id, mirrored), hiddenOf(row.id, values), 1e-5F) << row.name;
    EXPECT_NEAR(hiddenOf(row.id, transposed), hiddenOf(row.id, values), 1e-5F) << row.name;
  }
}

TEST(Hiddenness, StaysInRangeOnRandomBlocks) {
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    const std::uint32_t width = 1 + random.below(16);
    const std::uint32_t height = 1 + random.below(16);
    std::vector<float> opacity(std::size_t{width} * height);
    for (float& value : opacity)
      value = random.below(2) == 0 ? random.uniform() : static_cast<float>(random.below(2));
    for (const LvMeasure measure : {LvMeasure::kNone, LvMeasure::kSpectral, LvMeasure::kChord, LvMeasure::kCoverage}) {
      const float lv = blockLv(traitsOf(measure), {width, height, opacity}, 4.0F);
      ASSERT_GE(lv, -1.0001F);
      ASSERT_LE(lv, 1.0001F);
    }
  }
}

}  // namespace
}  // namespace jalousie::visibility
