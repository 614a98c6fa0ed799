// The thesis' mapping from LV to detail.
#include "visibility/lod_policy.h"

#include <gtest/gtest.h>

namespace jalousie::visibility {
namespace {

TEST(LodPolicy, ThesisExampleGivesLevelFour) {
  EXPECT_EQ(tessellationLevel(641.0F / 1024.0F, 20), 4U);
}

TEST(LodPolicy, EndsMapToFinestAndCoarsest) {
  EXPECT_EQ(tessellationLevel(-1.0F, 20), 20U);
  EXPECT_EQ(tessellationLevel(1.0F, 20), 1U);
  EXPECT_EQ(linearLod(-1.0F, 10), 0U);
  EXPECT_EQ(linearLod(1.0F, 10), 9U);
}

TEST(LodPolicy, ValuesOutsideTheNominalRangeAreClamped) {
  EXPECT_EQ(tessellationLevel(-1.83F, 20), 20U);
  EXPECT_EQ(tessellationLevel(1.5F, 20), 1U);
  EXPECT_EQ(linearLod(-1.83F, 7), 0U);
}

TEST(LodPolicy, DetailNeverGrowsWithHiddenness) {
  for (const unsigned levels : {1U, 2U, 10U, 20U, 32U}) {
    unsigned last = levels;
    for (int step = -200; step <= 200; ++step) {
      const unsigned level = tessellationLevel(static_cast<float>(step) / 150.0F, levels);
      EXPECT_LE(level, last);
      EXPECT_GE(level, 1U);
      EXPECT_EQ(linearLod(static_cast<float>(step) / 150.0F, levels), levels - level);
      last = level;
    }
  }
}

}  // namespace
}  // namespace jalousie::visibility
