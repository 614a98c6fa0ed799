// A software device for schedulers: objects are their boxes, a pixel is a ray through its centre.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "culling/query_device.h"
#include "culling/query_schedule.h"
#include "scene/camera.h"

namespace jalousie::test {

/// Draws and answers in double precision, so that no rounding decides.
class RasterDevice : public culling::QueryDevice {
 public:
  static constexpr std::uint32_t kSide = 40;  ///< pixels, a square picture
  static constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

  RasterDevice(const culling::SpatialHierarchy& tree, const scene::Camera& camera, std::uint32_t threshold,
               std::uint32_t capacity);

  /// Begins another frame.
  void begin(const scene::Camera& camera, const culling::QueryView& view);
  std::uint32_t capacity() const override { return capacity_; }

  const std::vector<std::uint32_t>& ids() const { return ids_; }  ///< of objects, by pixel
  const std::vector<double>& depths() const { return depths_; }   ///< distance along the ray
  std::uint64_t drawn() const { return drawnCount_; }
  bool drewTwice() const { return drewTwice_; }
  std::size_t unanswered() const { return answers_.size(); }
  std::size_t mostUnanswered() const { return mostUnanswered_; }
  /// Draws everything, as the picture to compare with.
  void drawAll();

 private:
  Query startQuery(std::span<const std::uint32_t> nodes) override;
  std::uint64_t takeAnswer(Query query) override;
  void drawObjects(std::uint32_t first, std::uint32_t count) override;
  void drawConditionally(std::span<const Conditional> ranges) override;
  /// Distance at which the ray of a pixel enters a box, no nearer than the near plane; infinite if it misses.
  double enter(std::uint32_t pixel, const Aabb& box) const;

  const culling::SpatialHierarchy& tree_;
  scene::Camera camera_;
  const culling::QueryView* view_ = nullptr;
  std::uint32_t threshold_;
  std::uint32_t capacity_;
  std::vector<std::uint32_t> ids_;
  std::vector<double> depths_;
  std::vector<glm::dvec3> rays_;
  std::vector<bool> isDrawn_;
  std::uint64_t drawnCount_ = 0;
  bool drewTwice_ = false;
  std::map<Query, std::uint64_t> answers_;
  Query next_ = 0;
  std::size_t mostUnanswered_ = 0;
};

}  // namespace jalousie::test
