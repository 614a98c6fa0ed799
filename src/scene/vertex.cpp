// Packing of normals and colours.
#include "scene/vertex.h"

#include <algorithm>
#include <cmath>

namespace jalousie::scene {

std::uint32_t packNormal(const glm::vec3& normal) {
  std::uint32_t packed = 0;
  for (int k = 0; k < 3; ++k) {
    const long value = std::lround(std::clamp(normal[k], -1.0F, 1.0F) * 511.0F);
    packed |= (static_cast<std::uint32_t>(value) & 0x3ffU) << (10 * k);
  }
  return packed;
}

std::uint32_t packColor(const glm::vec4& color) {
  std::uint32_t packed = 0;
  for (int k = 0; k < 4; ++k) {
    const float value = std::clamp(color[k], 0.0F, 1.0F);
    packed |= static_cast<std::uint32_t>(std::lround(value * 255.0F)) << (8 * k);
  }
  return packed;
}

}  // namespace jalousie::scene
