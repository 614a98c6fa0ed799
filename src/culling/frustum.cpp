// All sums in double precision: products of floats are exact, and rounding keeps their order.
#include "culling/frustum.h"

#include <algorithm>
#include <cmath>

#include "shared/limits.h"

namespace jalousie::culling {

Frustum::Frustum(const glm::mat4& clipFromWorld) {
  const glm::dmat4 rows = glm::transpose(glm::dmat4(clipFromWorld));
  const std::array<glm::dvec4, kPlanes> planes = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                                  rows[3] - rows[1], rows[2],           rows[3] - rows[2]};
  for (std::uint32_t i = 0; i < kPlanes; ++i)
    planes_[i] = {glm::dvec3(planes[i]), planes[i].w, glm::length(glm::dvec3(planes[i]))};
}

/// Grows with every coordinate's magnitude; the same for all corners of equal reach.
double Frustum::roundingAt(const Plane& plane, const glm::dvec3& reach) const {
  return double{gpu::kRounding} * (std::abs(plane.normal.x) * reach.x + std::abs(plane.normal.y) * reach.y +
                                   std::abs(plane.normal.z) * reach.z + std::abs(plane.offset));
}

Frustum::Side Frustum::sideOf(const Aabb& boxWorld, std::uint32_t plane) const {
  const Plane& p = planes_[plane];
  const glm::dvec3 low(boxWorld.min);
  const glm::dvec3 high(boxWorld.max);
  double farthest = p.offset;
  double nearest = p.offset;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = p.normal[axis] * low[axis];
    const double b = p.normal[axis] * high[axis];
    farthest += std::max(a, b);
    nearest += std::min(a, b);
  }
  if (farthest < -roundingAt(p, glm::max(glm::abs(low), glm::abs(high)))) return Side::kOutside;
  return nearest >= 0.0 ? Side::kInside : Side::kCrosses;
}

Frustum::Side Frustum::sideOf(const glm::dvec3& centerWorld, double radius, std::uint32_t plane) const {
  const Plane& p = planes_[plane];
  const double distance = glm::dot(p.normal, centerWorld) + p.offset;
  const double reach = radius * p.length;
  const double rounding = 2.0 * roundingAt(p, glm::abs(centerWorld) + radius);
  if (distance < -reach - rounding) return Side::kOutside;
  return distance > reach + rounding ? Side::kInside : Side::kCrosses;
}

float QueryView::distanceTo(const Aabb& boxWorld) const {
  if (!orthographic) {
    return glm::length(glm::max(glm::max(boxWorld.min - eyeWorld, eyeWorld - boxWorld.max), glm::vec3(0.0F)));
  }
  const glm::vec3 closest =
      glm::min(forwardWorld * (boxWorld.min - eyeWorld), forwardWorld * (boxWorld.max - eyeWorld));
  return std::max(closest.x + closest.y + closest.z, 0.0F);
}

bool QueryView::reachesNear(const Aabb& boxWorld) const {
  const float growth = queryGrowth(*this, boxWorld);
  constexpr float kLargest = 1e15F;  // products with a matrix overflow far beyond
  const float reach = glm::length(glm::max(glm::abs(boxWorld.min), glm::abs(boxWorld.max)));
  if (!(growth + reach < kLargest)) return true;
  // Not the negation of ">": sums that are no number count as near.
  return !(distanceTo({boxWorld.min - growth, boxWorld.max + growth}) > nearReach);
}

float queryGrowth(const QueryView& view, const Aabb& boxWorld) {
  if (view.orthographic) return view.pixelWidth;
  const glm::vec3 farthest =
      glm::max(view.forwardWorld * (boxWorld.min - view.eyeWorld), view.forwardWorld * (boxWorld.max - view.eyeWorld));
  return view.pixelWidth * std::max(farthest.x + farthest.y + farthest.z, 0.0F);
}

QueryView makeQueryView(const glm::mat4& clipFromWorld, const glm::vec4& eyeWorld, const glm::vec4& forwardWorld,
                        float focalPixels, const glm::uvec2& viewport) {
  const bool orthographic = forwardWorld.w != 0.0F;
  // The near rectangle's corner in units of the near distance.
  const glm::vec2 tangent = glm::vec2(viewport) * 0.5F / focalPixels;
  const float corner = orthographic ? 1.0F : std::sqrt(1.0F + glm::dot(tangent, tangent));
  constexpr float kSlack = 1.01F;
  return {.frustum = Frustum(clipFromWorld),
          .eyeWorld = glm::vec3(eyeWorld),
          .forwardWorld = glm::vec3(forwardWorld),
          .orthographic = orthographic,
          .nearReach = kSlack * corner * eyeWorld.w,
          .pixelWidth = 1.0F / focalPixels};
}

}  // namespace jalousie::culling
