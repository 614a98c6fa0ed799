// What two sweeps over tau say at equal image error; needs no OpenGL.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace jalousie::bench {

inline constexpr float kTaus[] = {8.0F, 4.0F, 2.0F, 1.0F, 0.5F, 0.25F, 0.125F};  // pixels
inline constexpr std::size_t kOnePixel = 3;                                      // index of tau = 1

/// One picture, or the mean of several, against the one with every object at its finest level.
struct Sample {
  double triangles = 0.0;
  double psnr = 0.0;           ///< dB
  double ssim = 0.0;           ///< 1 for equal pictures
  double flip = std::nan("");  ///< mean over covered pixels, 0 for equal pictures; NaN where it was not measured
};

/// A measure of the error of a Sample.
struct ErrorMeasure {
  const char* name;  ///< also its key in JSON
  double Sample::*value;
  bool falls;  ///< smaller values are better

  /// Grows where the picture becomes better.
  double quality(const Sample& sample) const { return quality(sample.*value); }
  double quality(double measured) const { return falls ? -measured : measured; }
};
inline constexpr ErrorMeasure kPsnr = {"psnr", &Sample::psnr, false};
inline constexpr ErrorMeasure kSsim = {"ssim", &Sample::ssim, false};
inline constexpr ErrorMeasure kFlip = {"flip", &Sample::flip, true};
inline constexpr ErrorMeasure kMeasures[] = {kPsnr, kSsim, kFlip};

/// Mean of samples of several pictures: of triangles, SSIM and FLIP the arithmetic mean, of PSNR that of the mean
/// squared error, so that equal pictures count as an error of 0. @pre samples not empty (checked)
Sample meanOf(const std::vector<Sample>& samples);

/// Triangles at which a sweep reaches a value of a measure: the logarithm of the triangles is interpolated linearly
/// between samples. Below its range the cheapest sample counts; above it, and for NaN, the result is NaN.
/// @param samples  in the order of falling tau, not empty
double trianglesAt(const std::vector<Sample>& samples, const ErrorMeasure& measure, double value);

/// Ratios of triangles at the errors that `levels` has at a tau of 2, 1, 0.5 and 0.25; NaN for errors that are not in
/// the range of both sweeps. Fewer where `levels` ends earlier. @param levels  a sweep over kTaus
std::vector<double> ratiosAtEqualErrors(const std::vector<Sample>& samples, const std::vector<Sample>& base,
                                        const std::vector<Sample>& levels, const ErrorMeasure& measure);
/// Their geometric mean; NaN if no error is in the range of both sweeps.
double ratioAtEqualError(const std::vector<Sample>& samples, const std::vector<Sample>& base,
                         const std::vector<Sample>& levels, const ErrorMeasure& measure = kPsnr);

/// Geometric mean of the values that are not NaN; NaN if there are none. @pre values > 0
double geometricMean(const std::vector<double>& values);

}  // namespace jalousie::bench
