// Means over kept frames, interpolation between logarithms, Pareto front.
#include "compare/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace jalousie::compare {
namespace {

/// Logarithm of a count or an error; a value of 0 counts as 1e-9.
double logOf(double value) {
  return std::log(std::max(value, 1e-9));
}

}  // namespace

double meanSquaredError(double psnr) {
  return std::isinf(psnr) ? 0.0 : 255.0 * 255.0 * std::pow(10.0, -psnr / 10.0);
}

double psnrOf(double squaredError) {
  return squaredError > 0.0 ? 10.0 * std::log10(255.0 * 255.0 / squaredError) : std::numeric_limits<double>::infinity();
}

std::vector<CurvePoint> curveOf(const Results& results, std::size_t configuration, std::size_t keptFrames) {
  std::map<float, std::vector<const SweepSample*>> byTau;
  for (const SweepSample& sample : results.sweep)
    if (sample.configuration == configuration) byTau[sample.tau].push_back(&sample);
  std::vector<CurvePoint> curve;
  for (const auto& [tau, samples] : byTau) {
    if (samples.size() < keptFrames) continue;
    CurvePoint point{static_cast<double>(tau), 0.0, 0.0, 0.0, 0.0, 0.0, {}};
    double squares = 0.0;
    const auto count = static_cast<double>(samples.size());
    for (const SweepSample* sample : samples) {
      point.triangles += static_cast<double>(sample->triangles) / count;
      point.frameMs += sample->frameMs / count;
      point.flip += sample->error.flip / count;
      point.ssim += sample->error.ssim / count;
      squares += meanSquaredError(sample->error.psnr) / count;
      if (sample->error.butteraugli)
        point.butteraugli = point.butteraugli.value_or(0.0) + *sample->error.butteraugli / count;
    }
    point.psnr = psnrOf(squares);
    curve.push_back(point);
  }
  std::stable_sort(curve.begin(), curve.end(),
                   [](const CurvePoint& a, const CurvePoint& b) { return a.triangles < b.triangles; });
  return curve;
}

std::optional<double> trianglesAtFlip(const std::vector<CurvePoint>& curve, double flip) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].flip > flip) continue;
    if (i == 0) return curve[0].triangles;
    const double from = logOf(curve[i - 1].flip);
    const double share = (from - logOf(flip)) / (from - logOf(curve[i].flip));
    return std::exp(std::lerp(logOf(curve[i - 1].triangles), logOf(curve[i].triangles), share));
  }
  return std::nullopt;
}

std::optional<double> flipAtTriangles(const std::vector<CurvePoint>& curve, double triangles) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].triangles < triangles) continue;
    if (curve[i].triangles <= triangles) return curve[i].flip;
    if (i == 0) return std::nullopt;
    const double from = logOf(curve[i - 1].triangles);
    const double share = (logOf(triangles) - from) / (logOf(curve[i].triangles) - from);
    return std::exp(std::lerp(logOf(curve[i - 1].flip), logOf(curve[i].flip), share));
  }
  return std::nullopt;
}

std::vector<std::size_t> paretoFront(const std::vector<CurvePoint>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (points[a].triangles < points[b].triangles) return true;
    if (points[b].triangles < points[a].triangles) return false;
    return points[a].flip < points[b].flip;
  });
  std::vector<std::size_t> front;
  double best = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (points[i].flip >= best) continue;
    best = points[i].flip;
    front.push_back(i);
  }
  return front;
}

}  // namespace jalousie::compare
