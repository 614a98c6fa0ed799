#include "culling/query_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace jalousie::test {

RasterDevice::RasterDevice(const culling::SpatialHierarchy& tree, const scene::Camera& camera, std::uint32_t threshold,
                           std::uint32_t capacity)
    : tree_(tree), camera_(camera), threshold_(threshold), capacity_(capacity) {}

void RasterDevice::begin(const scene::Camera& camera, const culling::QueryView& view) {
  camera_ = camera;
  view_ = &view;
  ids_.assign(std::size_t{kSide} * kSide, kNothing);
  depths_.assign(ids_.size(), std::numeric_limits<double>::infinity());
  isDrawn_.assign(tree_.objects.size(), false);
  drawnCount_ = 0;
  rays_.clear();
  const double half = std::tan(0.5 * camera.fovY);
  for (std::uint32_t pixel = 0; pixel < ids_.size(); ++pixel) {
    const double x = ((pixel % kSide + 0.5) / kSide * 2.0 - 1.0) * half;
    const double y = ((pixel / kSide + 0.5) / kSide * 2.0 - 1.0) * half;
    rays_.emplace_back(glm::dmat3(glm::mat3(camera.worldFromCamera)) * glm::dvec3(x, y, -1.0));
  }
}

double RasterDevice::enter(std::uint32_t pixel, const Aabb& box) const {
  const glm::dvec3 eye(camera_.positionWorld());
  double from = camera_.zNear;
  double to = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    double a = (box.min[axis] - eye[axis]) / rays_[pixel][axis];
    double b = (box.max[axis] - eye[axis]) / rays_[pixel][axis];
    if (a > b) std::swap(a, b);
    from = std::max(from, a);
    to = std::min(to, b);
  }
  return from <= to ? from : std::numeric_limits<double>::infinity();
}

void RasterDevice::drawObjects(std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t i = first; i < first + count; ++i) {
    drewTwice_ = drewTwice_ || isDrawn_[i];
    isDrawn_[i] = true;
    ++drawnCount_;
    for (std::uint32_t pixel = 0; pixel < ids_.size(); ++pixel) {
      const double depth = enter(pixel, tree_.objectBounds[i]);
      // Equal depths: the lower number wins, whatever the order of the draws.
      if (depth > depths_[pixel] || !std::isfinite(depth)) continue;
      if (depth == depths_[pixel] && ids_[pixel] < tree_.objects[i]) continue;
      depths_[pixel] = depth;
      ids_[pixel] = tree_.objects[i];
    }
  }
}

void RasterDevice::drawAll() {
  drawObjects(0, static_cast<std::uint32_t>(tree_.objects.size()));
}

RasterDevice::Query RasterDevice::startQuery(std::span<const std::uint32_t> nodes) {
  std::uint64_t samples = 0;
  for (const std::uint32_t node : nodes) {
    Aabb box = tree_.nodes[node].boundsWorld;
    const float growth = culling::queryGrowth(*view_, box);
    box = {box.min - growth, box.max + growth};
    for (std::uint32_t pixel = 0; pixel < depths_.size(); ++pixel) {
      const double depth = enter(pixel, box);
      if (std::isfinite(depth) && depth <= depths_[pixel]) ++samples;
    }
  }
  answers_[next_] = samples;
  mostUnanswered_ = std::max(mostUnanswered_, answers_.size());
  return next_++;
}

std::uint64_t RasterDevice::takeAnswer(Query query) {
  EXPECT_TRUE(answers_.contains(query)) << "an answer is taken once";
  const std::uint64_t samples = answers_[query];
  answers_.erase(query);
  return samples;
}

void RasterDevice::drawConditionally(std::span<const Conditional> ranges) {
  for (const Conditional& range : ranges)
    if (takeAnswer(range.query) > threshold_) drawObjects(range.first, range.count);
}

}  // namespace jalousie::test
