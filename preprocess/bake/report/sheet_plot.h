// Plots error over triangles as SVG.
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

/// Logarithmic on both axes, ticks at powers of ten, one dot per level. Points without a positive error are left out.
/// @return  an SVG element; empty if fewer than two points are left
std::string errorPlot(const std::vector<PlotPoint>& points);

}  // namespace jalousie::bake
