// Conversion of the views' colours.
#include "app/view/drawing.h"

#include <algorithm>
#include <cmath>

namespace jalousie::app {
namespace {

std::uint8_t srgbByte(float linear) {
  const float c = linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(std::clamp(c, 0.0F, 1.0F) * 255.0F));
}

}  // namespace

ImU32 srgb(const glm::vec3& linear) {
  return IM_COL32(srgbByte(linear.x), srgbByte(linear.y), srgbByte(linear.z), 255);
}

}  // namespace jalousie::app
