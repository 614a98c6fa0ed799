// Two-sided sampled distance; the maximum is also taken over all vertices of both surfaces.
#include "bake/measure.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace jalousie::bake {
namespace {

/// Fractional part of k times the plastic-number constants: an evenly spread sequence in the unit square (Roberts
/// 2018).
glm::dvec2 spread(std::uint64_t k) {
  const double x = 0.5 + 0.7548776662466927 * static_cast<double>(k);
  const double y = 0.5 + 0.5698402909980532 * static_cast<double>(k);
  return {x - std::floor(x), y - std::floor(y)};
}

struct OneSided {
  double max = 0.0;
  double mean = 0.0;
};

OneSided distances(const TriangleBvh& target, std::span<const glm::vec3> points) {
  std::vector<double> results(points.size());
  const unsigned threads = std::clamp(std::thread::hardware_concurrency(), 1U, 16U);
  {
    std::vector<std::jthread> workers;
    for (unsigned w = 0; w < threads; ++w)
      workers.emplace_back([&, w] {
        for (std::size_t i = w; i < points.size(); i += threads)
          results[i] = target.distance(points[i]);
      });
  }
  // Summed in order, whatever the threads did.
  OneSided side;
  for (const double distance : results) {
    side.max = std::max(side.max, distance);
    side.mean += distance;
  }
  side.mean /= static_cast<double>(std::max<std::size_t>(results.size(), 1));
  return side;
}

}  // namespace

std::vector<glm::vec3> samplePoints(const Surface& surface, std::uint32_t count) {
  const std::size_t triangles = surface.indices.size() / 3;
  std::vector<bool> used(surface.positions.size(), false);
  std::vector<double> cumulative(triangles);
  double area = 0.0;
  for (std::size_t t = 0; t < triangles; ++t) {
    const glm::dvec3 a(surface.positions[surface.indices[3 * t]]);
    const glm::dvec3 b(surface.positions[surface.indices[3 * t + 1]]);
    const glm::dvec3 c(surface.positions[surface.indices[3 * t + 2]]);
    for (std::size_t k = 0; k < 3; ++k)
      used[surface.indices[3 * t + k]] = true;
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
    cumulative[t] = area;
  }
  std::vector<glm::vec3> points;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) points.push_back(surface.positions[v]);
  if (!(area > 0.0)) return points;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double place = area * (k + 0.5) / count;
    const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), place);
    const std::size_t t = std::min(static_cast<std::size_t>(found - cumulative.begin()), triangles - 1);
    const glm::dvec2 r = spread(k);
    const double root = std::sqrt(r.x);
    const glm::dvec3 barycentric(1.0 - root, root * (1.0 - r.y), root * r.y);
    glm::dvec3 point(0.0);
    for (int corner = 0; corner < 3; ++corner)
      point += barycentric[corner] *
               glm::dvec3(surface.positions[surface.indices[3 * t + static_cast<std::size_t>(corner)]]);
    points.emplace_back(point);
  }
  return points;
}

DeviationMeter::DeviationMeter(const Surface& original, std::uint32_t samples)
    : original_(original.positions, original.indices),
      originalPoints_(samplePoints(original, samples)),
      samples_(samples) {}

Deviation DeviationMeter::measure(const Surface& level) const {
  const TriangleBvh levelBvh(level.positions, level.indices);
  const OneSided there = distances(original_, samplePoints(level, samples_));
  const OneSided back = distances(levelBvh, originalPoints_);
  return {std::max(there.max, back.max), std::max(there.mean, back.mean)};
}

}  // namespace jalousie::bake
