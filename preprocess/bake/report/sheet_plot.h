// The curve of error over triangles as SVG.
#pragma once

#include <string>
#include <vector>

namespace jalousie::bake {

/// One level of a chain: LOD 0 has no error and is not plotted.
struct PlotPoint {
  double triangles = 0.0;
  double max = 0.0;   ///< % of the diagonal
  double mean = 0.0;  ///< % of the diagonal
};

/// Logarithmic on both axes, ticks at powers of ten, one dot per level. Empty string without two points of positive
/// error.
std::string errorPlot(const std::vector<PlotPoint>& points);

}  // namespace jalousie::bake
