// The thesis' linear mapping; plain CPU twin of shaders/lib/lod.glsl.
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

}  // namespace jalousie::visibility
