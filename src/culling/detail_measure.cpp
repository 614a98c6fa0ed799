#include "culling/detail_measure.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace jalousie::culling {

double sphereArea(const glm::dvec3& centerView, double radius, double focalPixels) {
  const double depth = -centerView.z;
  if (depth <= radius) return std::numeric_limits<double>::infinity();
  const double square = radius * radius;
  const double beyond = depth * depth - square;
  const double distance = std::sqrt(glm::dot(centerView, centerView) - square);
  return std::numbers::pi * focalPixels * focalPixels * square * distance / (beyond * std::sqrt(beyond));
}

}  // namespace jalousie::culling
