// The thesis' linear mapping and the projected error; plain CPU twin of shaders/lib/lod.glsl.
#include "visibility/lod_policy.h"

#include <algorithm>
#include <cmath>

#include "shared/limits.h"

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

float relaxedBudget(float lv, float relax) {
  static_assert(gpu::kRelaxPower == 4);
  const float h2 = hiddenShare(lv) * hiddenShare(lv);
  return 1.0F + relax * h2 * h2;
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

void chooseDetail(const gpu::CullView& view, std::span<const gpu::Lod> levels, float patchError,
                  const gpu::ScreenBox& box, gpu::ObjectState& state) {
  if (view.lodRule == gpu::kLodLinear) {
    state.lod = linearLod(state.lv, static_cast<std::uint32_t>(levels.size()));
    state.tessellation = tessellationLevel(state.lv, view.maxTessellation);
  } else if (view.lodRule == gpu::kLodPixelError || view.lodRule == gpu::kLodLvError) {
    const float budget = view.lodRule == gpu::kLodLvError ? box.tau * relaxedBudget(state.lv, view.relax) : box.tau;
    state.lod = pixelErrorLod(levels, box.pixelsPerUnit, budget);
    state.tessellation = pixelErrorTessellation(patchError * box.pixelsPerUnit, budget, view.maxTessellation);
  }
}

}  // namespace jalousie::visibility
