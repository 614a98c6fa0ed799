// The thesis' linear mapping and the projected error; plain CPU twin of shaders/lib/lod.glsl.
#include "visibility/lod_policy.h"

#include <algorithm>
#include <cmath>

namespace jalousie::visibility {

float hiddenShare(float lv) {
  return (std::clamp(lv, -1.0F, 1.0F) + 1.0F) * 0.5F;
}

std::uint32_t tessellationLevel(float lv, std::uint32_t levels) {
  const float t = hiddenShare(lv);
  const auto finest = static_cast<float>(levels);
  return static_cast<std::uint32_t>(std::clamp(std::floor(finest * (1.0F - t) + t), 1.0F, finest));
}

std::uint32_t linearLod(float lv, std::uint32_t lodCount) {
  return lodCount - tessellationLevel(lv, lodCount);
}

float projectedScale(float scale, float focalPixels, float distance, float radius, float zNear) {
  return scale * focalPixels / std::max(distance - radius, zNear);
}

std::uint32_t pixelErrorLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau) {
  for (std::size_t level = levels.size() - 1; level > 0; --level)
    if (levels[level].errorObject * pixelsPerUnit <= tau) return static_cast<std::uint32_t>(level);
  return 0;
}

std::uint32_t pixelErrorTessellation(float errorPixels, float tau, std::uint32_t maxLevel) {
  if (errorPixels <= tau) return 1;
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil(std::sqrt(errorPixels / tau)), 1.0F, static_cast<float>(maxLevel)));
}

}  // namespace jalousie::visibility
