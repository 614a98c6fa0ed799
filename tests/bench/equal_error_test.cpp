// The comparison of sweeps at equal error, with numbers that can be checked by hand.
#include "equal_error.h"

#include <gtest/gtest.h>

#include <limits>

namespace jalousie::bench {
namespace {

/// Triangles, PSNR, SSIM, FLIP. PSNR and SSIM rise and FLIP falls where triangles double twice.
const std::vector<Sample> kSweep = {{100, 20, 0.80, 0.30}, {400, 30, 0.90, 0.20}, {1600, 40, 0.98, 0.10}};

/// The same errors with `factor` times as many triangles.
std::vector<Sample> scaled(std::vector<Sample> samples, double factor) {
  for (Sample& sample : samples)
    sample.triangles *= factor;
  return samples;
}

TEST(EqualError, RisingMeasuresAreInterpolated) {
  EXPECT_NEAR(trianglesAt(kSweep, kPsnr, 25.0), 200.0, 1e-9);
  EXPECT_NEAR(trianglesAt(kSweep, kPsnr, 40.0), 1600.0, 1e-9);
  EXPECT_NEAR(trianglesAt(kSweep, kSsim, 0.94), 800.0, 1e-9);
}

TEST(EqualError, FallingMeasuresAreInterpolated) {
  EXPECT_NEAR(trianglesAt(kSweep, kFlip, 0.25), 200.0, 1e-9);
  EXPECT_NEAR(trianglesAt(kSweep, kFlip, 0.15), 800.0, 1e-9);
  EXPECT_NEAR(trianglesAt(kSweep, kFlip, 0.10), 1600.0, 1e-9);
}

TEST(EqualError, WorseErrorsThanTheSweepHasCostItsCheapestSample) {
  EXPECT_EQ(trianglesAt(kSweep, kPsnr, 10.0), 100.0);
  EXPECT_EQ(trianglesAt(kSweep, kFlip, 0.5), 100.0);
}

TEST(EqualError, BetterErrorsThanTheSweepHasAreNotANumber) {
  EXPECT_TRUE(std::isnan(trianglesAt(kSweep, kPsnr, 41.0)));
  EXPECT_TRUE(std::isnan(trianglesAt(kSweep, kFlip, 0.05)));
  EXPECT_TRUE(std::isnan(trianglesAt(kSweep, kFlip, std::nan(""))));
}

TEST(EqualError, NoInterpolationReachesAnInfinitePsnr) {
  const std::vector<Sample> samples = {{100, 20}, {400, std::numeric_limits<double>::infinity()}};
  EXPECT_TRUE(std::isnan(trianglesAt(samples, kPsnr, 30.0)));
}

TEST(EqualError, RatioIsThatOfTheTrianglesForEveryMeasure) {
  // Seven samples, as a sweep over kTaus has.
  std::vector<Sample> base;
  base.reserve(7);
  for (int i = 0; i < 7; ++i)
    base.push_back({100.0 * std::pow(2.0, i), 20.0 + i, 0.8 + 0.02 * i, 0.3 - 0.04 * i});
  for (const ErrorMeasure& measure : {kPsnr, kSsim, kFlip}) {
    EXPECT_NEAR(ratioAtEqualError(scaled(base, 0.7), base, base, measure), 0.7, 1e-9) << measure.name;
    EXPECT_NEAR(ratioAtEqualError(base, base, base, measure), 1.0, 1e-9) << measure.name;
  }
  EXPECT_TRUE(std::isnan(ratioAtEqualError({{100, 50}}, base, {{1, 90}, {1, 90}, {1, 90}}))) << "no common error";
}

TEST(EqualError, ErrorsOutsideOneSweepHaveNoRatio) {
  const std::vector<Sample> base = {{100, 20}, {200, 21}, {400, 22}, {800, 23}, {1600, 24}, {3200, 25}};
  const std::vector<Sample> shorter = {{50, 20}, {100, 21}, {200, 22}, {400, 23}};
  const std::vector<double> ratios = ratiosAtEqualErrors(shorter, base, base, kPsnr);
  ASSERT_EQ(ratios.size(), 4U);
  EXPECT_NEAR(ratios[0], 0.5, 1e-9);
  EXPECT_NEAR(ratios[1], 0.5, 1e-9);
  EXPECT_TRUE(std::isnan(ratios[2]));
  EXPECT_TRUE(std::isnan(ratios[3]));
  EXPECT_NEAR(ratioAtEqualError(shorter, base, base), 0.5, 1e-9);
}

TEST(EqualError, AMissingMeasureGivesNoRatio) {
  const std::vector<Sample> samples = {{100, 20, 0.8}, {200, 21, 0.9}, {400, 22, 0.95}};
  EXPECT_TRUE(std::isnan(ratioAtEqualError(samples, samples, samples, kFlip)));
}

TEST(EqualError, MeanPsnrIsThatOfTheMeanSquaredError) {
  const double exact = std::numeric_limits<double>::infinity();
  const Sample mean = meanOf({{100, 20, 0.8, 0.2}, {300, exact, 1.0, 0.0}});
  EXPECT_NEAR(mean.psnr, 20.0 + 10.0 * std::log10(2.0), 1e-9);
  EXPECT_NEAR(mean.triangles, 200.0, 1e-9);
  EXPECT_NEAR(mean.ssim, 0.9, 1e-9);
  EXPECT_NEAR(mean.flip, 0.1, 1e-9);
}

TEST(EqualError, GeometricMeanLeavesOutWhatWasNotMeasured) {
  EXPECT_NEAR(geometricMean({0.5, std::nan(""), 2.0, 1.0}), 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(geometricMean({std::nan("")})));
  EXPECT_TRUE(std::isnan(geometricMean({})));
}

}  // namespace
}  // namespace jalousie::bench
