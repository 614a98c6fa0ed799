// Draws the axes, the ticks and one polyline each for maximum and mean.
#include "bake/report/sheet_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace jalousie::bake {
namespace {

constexpr double kWidth = 640.0;
constexpr double kHeight = 300.0;
constexpr double kLeft = 64.0;
constexpr double kRight = 92.0;
constexpr double kTop = 14.0;
constexpr double kBottom = 44.0;

/// A logarithmic axis between whole powers of ten.
struct Axis {
  double low, high;    ///< exponents
  double first, last;  ///< pixels
  double at(double value) const { return first + (std::log10(value) - low) / (high - low) * (last - first); }
};

Axis axisFor(double smallest, double largest, double first, double last) {
  Axis axis{std::floor(std::log10(smallest)), std::ceil(std::log10(largest)), first, last};
  if (axis.high <= axis.low) axis.high = axis.low + 1.0;
  return axis;
}

std::string tickLabel(double value) {
  if (value >= 1e6) return fmt::format("{:g} M", value / 1e6);
  if (value >= 1e3) return fmt::format("{:g} k", value / 1e3);
  return fmt::format("{:g}", value);
}

/// How one figure of the points is drawn.
struct CurveStyle {
  double PlotPoint::*figure;
  const char* color;
  const char* name;  ///< written at the finest level's end
};

std::string curve(const std::vector<PlotPoint>& points, const Axis& x, const Axis& y, const CurveStyle& style) {
  std::string line;
  std::string dots;
  for (const PlotPoint& point : points) {
    const double px = x.at(point.triangles);
    const double py = y.at(point.*style.figure);
    line += fmt::format("{:.1f},{:.1f} ", px, py);
    dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.5' fill='{}'/>", px, py, style.color);
  }
  const PlotPoint& finest = points.front();
  return fmt::format(
      "<polyline points='{}' fill='none' stroke='{}' stroke-width='2'/>{}"
      "<text x='{:.1f}' y='{:.1f}' style='fill:{}' dy='4'>{}</text>",
      line, style.color, dots, x.at(finest.triangles) + 10.0, y.at(finest.*style.figure), style.color, style.name);
}

}  // namespace

std::string errorPlot(const std::vector<PlotPoint>& all) {
  std::vector<PlotPoint> points;
  std::copy_if(all.begin(), all.end(), std::back_inserter(points),
               [](const PlotPoint& p) { return p.triangles > 0.0 && p.max > 0.0 && p.mean > 0.0; });
  if (points.size() < 2) return {};
  double low = points[0].mean;
  double high = points[0].max;
  for (const PlotPoint& p : points) {
    low = std::min({low, p.mean, p.max});
    high = std::max({high, p.mean, p.max});
  }
  const Axis x = axisFor(points.back().triangles, points.front().triangles, kLeft, kWidth - kRight);
  const Axis y = axisFor(low, high, kHeight - kBottom, kTop);
  std::string svg =
      fmt::format("<svg viewBox='0 0 {} {}' role='img' aria-label='error over triangles'>", kWidth, kHeight);
  for (double exponent = x.low; exponent <= x.high; ++exponent) {
    const double px = x.at(std::pow(10.0, exponent));
    svg += fmt::format(
        "<line x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}' class='grid'/>"
        "<text x='{0:.1f}' y='{3}' text-anchor='middle'>{4}</text>",
        px, kTop, kHeight - kBottom, kHeight - kBottom + 18.0, tickLabel(std::pow(10.0, exponent)));
  }
  for (double exponent = y.low; exponent <= y.high; ++exponent) {
    const double py = y.at(std::pow(10.0, exponent));
    svg += fmt::format(
        "<line x1='{1}' x2='{2}' y1='{0:.1f}' y2='{0:.1f}' class='grid'/>"
        "<text x='{3}' y='{0:.1f}' dy='4' text-anchor='end'>{4:g} %</text>",
        py, kLeft, kWidth - kRight, kLeft - 8.0, std::pow(10.0, exponent));
  }
  svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>triangles</text>", 0.5 * (kLeft + kWidth - kRight),
                     kHeight - 6.0);
  svg += curve(points, x, y, {&PlotPoint::max, "#b5432f", "max"});
  svg += curve(points, x, y, {&PlotPoint::mean, "#2f6fb5", "mean"});
  return svg + "</svg>";
}

}  // namespace jalousie::bake
