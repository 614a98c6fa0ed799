// What an experiment says: figures per configuration, ratios to the baseline, cost at equal error. Stable keys.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/experiment.h"

namespace jalousie::compare {

/// Median and quartiles; all 0 for no values. Between two values the mean weighted by position counts.
struct Spread {
  double median = 0.0;
  double lower = 0.0;  ///< first quartile
  double upper = 0.0;  ///< third quartile
};
Spread spreadOf(std::vector<double> values);

/// A curve of cost over error, one point per tau.
struct CurvePoint {
  double tau = 1.0;
  double triangles = 0.0;  ///< mean over the kept frames
  double frameMs = 0.0;    ///< likewise
  double flip = 0.0;
  double psnr = 0.0;  ///< of the mean squared error
  double ssim = 1.0;
};

/// Points of one configuration, ascending by triangles. Only taus that all kept frames have been measured with.
std::vector<CurvePoint> curveOf(const Results& results, std::size_t configuration, std::size_t keptFrames);

/// Triangles at which a curve reaches an error: interpolated between the logarithms; absent if it never gets there.
/// Where its coarsest point is good enough, that one counts.
std::optional<double> trianglesAtFlip(const std::vector<CurvePoint>& curve, double flip);
/// FLIP of a curve at a number of triangles, interpolated likewise; absent outside its range.
std::optional<double> flipAtTriangles(const std::vector<CurvePoint>& curve, double triangles);

/// Indices of the points that no other point beats in both triangles and FLIP. @param points  of all configurations
std::vector<std::size_t> paretoFront(const std::vector<CurvePoint>& points);

/// What stands beside the figures.
struct Circumstances {
  std::string scene;     ///< file name
  std::string path;      ///< file name of the camera path; empty: the scene's own
  std::string renderer;  ///< GL_RENDERER
  std::string timing;    ///< "wall" or "gpu"
  std::string command;   ///< to repeat it
  std::string version;
};

/// summary.json; keys in docs/compare.md.
nlohmann::ordered_json summaryJson(const Results& results, const std::vector<Configuration>& configurations,
                                   const Plan& plan, const Circumstances& circumstances);

/// frames.csv: one line per frame and configuration. Pass times are columns, empty where a pass did not run.
std::string framesCsv(const Results& results, const std::vector<Configuration>& configurations);

/// The headline for a terminal.
std::string summaryText(const nlohmann::ordered_json& summary);

}  // namespace jalousie::compare
