// Frustum culling and occluder selection, one box at a time (thesis 3.2, 4.1.2).
#include "visibility/classify_reference.h"

#include <limits>

namespace jalousie::visibility {
namespace {

glm::vec3 boxCorner(const Aabb& box, unsigned corner) {
  return {(corner & 1U) != 0 ? box.max.x : box.min.x, (corner & 2U) != 0 ? box.max.y : box.min.y,
          (corner & 4U) != 0 ? box.max.z : box.min.z};
}

unsigned planesBeyond(const glm::vec4& clip) {
  return (clip.x < -clip.w ? 1U : 0U) | (clip.x > clip.w ? 2U : 0U) | (clip.y < -clip.w ? 4U : 0U) |
         (clip.y > clip.w ? 8U : 0U) | (clip.z < 0.0F ? 16U : 0U) | (clip.z > clip.w ? 32U : 0U);
}

}  // namespace

BoxOnScreen boxOnScreen(const glm::mat4& worldFromObject, const Aabb& boundsObject, const glm::mat4& clipFromWorld,
                        const glm::vec2& viewport) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  BoxOnScreen result;
  glm::vec2 lowest(kInfinity);
  glm::vec2 highest(-kInfinity);
  float smallestW = kInfinity;
  unsigned beyondAll = 63;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::vec3 world(worldFromObject * glm::vec4(boxCorner(boundsObject, corner), 1.0F));
    result.boundsWorld.add(world);
    const glm::vec4 clip = clipFromWorld * glm::vec4(world, 1.0F);
    beyondAll &= planesBeyond(clip);
    smallestW = glm::min(smallestW, clip.w);
    const glm::vec2 pixels = (glm::vec2(clip) / clip.w * 0.5F + 0.5F) * viewport;
    lowest = glm::min(lowest, pixels);
    highest = glm::max(highest, pixels);
  }
  result.outside = beyondAll != 0;
  result.crossesNear = !(smallestW > 0.0F);
  lowest = glm::clamp(lowest, glm::vec2(0.0F), viewport);
  highest = glm::clamp(highest, glm::vec2(0.0F), viewport);
  result.rect = {lowest.x, lowest.y, highest.x, highest.y};
  return result;
}

float distanceToBox(const glm::vec3& point, const Aabb& box) {
  return glm::length(glm::max(glm::max(box.min - point, point - box.max), glm::vec3(0.0F)));
}

gpu::uint classify(const BoxOnScreen& box, const gpu::CullView& view) {
  if (view.cullMode == gpu::kCullNone) return gpu::kVerdictPending;
  if (box.outside) return gpu::kVerdictOutside;
  if (view.cullMode == gpu::kCullHom &&
      distanceToBox(glm::vec3(view.cameraWorld), box.boundsWorld) < view.occluderDistance)
    return gpu::kVerdictOccluder;
  return box.crossesNear ? gpu::kVerdictNear : gpu::kVerdictPending;
}

}  // namespace jalousie::visibility
