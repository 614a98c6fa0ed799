// Boxes that touch a plane of the clip volume as closely as 32-bit numbers allow: the worst input of the frustum test.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "core/aabb.h"
#include "core/random.h"
#include "shared/scene_structs.h"

namespace jalousie::visibility {

/// For each plane of the clip volume (left, right, bottom, top, far, near) how far inside the innermost corner of the
/// box lies, in clip space; negative if all corners lie beyond the plane. In double precision, from the same numbers.
inline std::array<double, 6> cornersInside(const glm::mat4& clipFromWorld, const gpu::Transform& t, const Aabb& box) {
  std::array<double, 6> inside;
  inside.fill(-1e300);
  const glm::dmat4 clipMatrix(clipFromWorld);
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p((corner & 1U) != 0 ? box.max.x : box.min.x, (corner & 2U) != 0 ? box.max.y : box.min.y,
                       (corner & 4U) != 0 ? box.max.z : box.min.z, 1.0);
    const glm::dvec4 clip = clipMatrix * glm::dvec4(glm::dot(glm::dvec4(t.worldFromObject0), p),
                                                    glm::dot(glm::dvec4(t.worldFromObject1), p),
                                                    glm::dot(glm::dvec4(t.worldFromObject2), p), 1.0);
    const double sides[] = {clip.w + clip.x, clip.w - clip.x, clip.w + clip.y,
                            clip.w - clip.y, clip.z,          clip.w - clip.z};
    for (std::size_t plane = 0; plane < 6; ++plane)
      inside[plane] = std::max(inside[plane], sides[plane]);
  }
  return inside;
}

/// Whether no plane has the whole box beyond it: the box must not be culled.
inline bool touchesFrustum(const std::array<double, 6>& inside) {
  return std::all_of(inside.begin(), inside.end(), [](double side) { return side >= 0.0; });
}

/// worldFromObject of boxes that are moved from a place in view to where their last corner lies on a plane, within the
/// rounding of their numbers. Half of them do not touch the plane.
/// @param start  world, in view   @param makeTransform  as the scene stores a transform
template <class MakeTransform>
std::vector<glm::mat4> touchingBoxes(const glm::mat4& clipFromWorld, const glm::vec3& start, const Aabb& box,
                                     std::size_t count, Random& random, const MakeTransform& makeTransform) {
  std::vector<glm::mat4> result;
  const glm::mat4 rows = glm::transpose(clipFromWorld);
  const glm::vec4 planes[] = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                              rows[3] - rows[1], rows[2],           rows[3] - rows[2]};
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 normal{glm::vec3(planes[i % 6])};
    const glm::vec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), 1.5F);
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0F), random.uniform(0, 6), glm::normalize(axis));
    const glm::mat4 shape = glm::scale(turned, glm::vec3(random.uniform(0.3F, 1.0F)));
    glm::dvec3 place(start);
    glm::mat4 world(1.0F);
    for (int step = 0; step < 3; ++step) {  // the second and third step remove what rounding left
      world = glm::translate(glm::mat4(1.0F), glm::vec3(place)) * shape;
      const double inside = cornersInside(clipFromWorld, makeTransform(world), box)[i % 6];
      place -= normal * (inside / glm::dot(normal, normal));
    }
    result.push_back(glm::translate(glm::mat4(1.0F), glm::vec3(place)) * shape);
  }
  return result;
}

}  // namespace jalousie::visibility
