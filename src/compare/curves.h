// Curves of cost over error that a sweep over tau draws, and what is read off them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "compare/results.h"

namespace jalousie::compare {

/// A configuration with one tau.
struct CurvePoint {
  double tau = 1.0;                        ///< pixels
  double triangles = 0.0;                  ///< mean over the kept frames
  double frameMs = 0.0;                    ///< likewise
  double flip = 0.0;                       ///< likewise
  double psnr = 0.0;                       ///< dB, of the mean squared error
  double ssim = 1.0;                       ///< mean over the kept frames
  std::optional<double> butteraugli = {};  ///< likewise; absent where it was not measured
};

/// Mean squared error of 8-bit values; 0 for an infinite PSNR. @param psnr  dB
double meanSquaredError(double psnr);
/// Inverse of meanSquaredError(), dB.
double psnrOf(double squaredError);

/// Points of one configuration, ascending by triangles. A tau that some kept frame has not been measured with is left
/// out, because its means would be over other frames. @param keptFrames  their number
std::vector<CurvePoint> curveOf(const Results& results, std::size_t configuration, std::size_t keptFrames);

/// Fewest triangles at which a curve reaches a FLIP of at most `flip`. Interpolates linearly between the logarithms of
/// neighbouring points. If already the first point reaches it, its triangles; absent if no point does.
/// @param curve  ascending by triangles
std::optional<double> trianglesAtFlip(const std::vector<CurvePoint>& curve, double flip);
/// FLIP of a curve at a number of triangles, interpolated likewise; absent outside the curve's range.
std::optional<double> flipAtTriangles(const std::vector<CurvePoint>& curve, double triangles);

/// Indices of the points that no other point beats in both triangles and FLIP, ascending by triangles.
/// @param points  of all configurations
std::vector<std::size_t> paretoFront(const std::vector<CurvePoint>& points);

}  // namespace jalousie::compare
