// The thesis' linear mapping and the projected error; plain CPU twin of shaders/lib/lod.glsl.
#include "visibility/lod_policy.h"

#include <algorithm>
#include <cmath>

#include "policy/traits.h"
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

float visibleShare(float lv) {
  return std::max(1.0F - hiddenShare(lv), gpu::kLeastShare);
}

float relaxedBudget(float lv, float relax) {
  const float share = visibleShare(lv);
  return std::min(1.0F / std::sqrt(std::sqrt(share)), 1.0F + relax);
}

float pixelsLv(float visible, float area) {
  return 1.0F - 2.0F * std::min((visible + gpu::kPixelGuard) / (gpu::kSilhouetteShare * area + gpu::kPixelGuard), 1.0F);
}

float smoothLv(float last, float measured) {
  const float start = std::clamp(last, -1.0F, 1.0F);
  return start +
         (measured < start ? gpu::kSmoothAppearing : gpu::kSmoothHiding) * (std::clamp(measured, -1.0F, 1.0F) - start);
}

float forgottenLv(float last) {
  const float start = std::clamp(last, -1.0F, 1.0F);
  return start + gpu::kSmoothHiding * (-1.0F - start);
}

float projectedScale(float scale, float focalPixels, float distance, float radius, float zNear) {
  return scale * focalPixels / std::max(distance - radius, zNear);
}

std::uint32_t pixelErrorLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau) {
  for (std::size_t level = levels.size() - 1; level > 0; --level)
    if (levels[level].errorObject * pixelsPerUnit <= tau) return static_cast<std::uint32_t>(level);
  return 0;
}

std::uint32_t relaxedLod(std::span<const gpu::Lod> levels, float pixelsPerUnit, float tau, float relaxed, float share) {
  std::uint32_t best = pixelErrorLod(levels, pixelsPerUnit, tau);
  const std::uint32_t coarsest = pixelErrorLod(levels, pixelsPerUnit, tau * relaxed);
  const auto triangles = static_cast<float>(std::max(levels[best].triangleCount, 1U));
  float leastCost = 0.0F;
  for (std::uint32_t level = best; level <= coarsest; ++level) {
    const float error = levels[level].errorObject * pixelsPerUnit / std::max(tau, gpu::kLeastShare);
    const float cost = share * error * error + static_cast<float>(levels[level].triangleCount) / triangles;
    if (leastCost == 0.0F || cost < leastCost) {
      leastCost = cost;
      best = level;
    }
  }
  return best;
}

std::uint32_t pixelErrorTessellation(float errorPixels, float tau, std::uint32_t maxLevel) {
  if (errorPixels <= tau) return 1;
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil(std::sqrt(errorPixels / tau)), 1.0F, static_cast<float>(maxLevel)));
}

std::uint32_t fadeFrames(gpu::uint marks) {
  return marks >> gpu::kMarkFadeShift;
}

std::uint32_t fadingLod(std::uint32_t lod, gpu::uint marks) {
  return (marks & gpu::kMarkFromCoarser) != 0 ? lod + 1 : lod - 1;
}

std::uint32_t stepTowards(std::uint32_t last, std::uint32_t lowest, std::uint32_t highest) {
  return last < lowest ? last + 1 : last > highest ? last - 1 : last;
}

namespace {

struct Budget {
  float tau, relaxed, share;
};

void followBudget(const gpu::CullView& view, std::span<const gpu::Lod> levels, float patchPixels, float pixelsPerUnit,
                  const Budget& budget, bool seen, const gpu::ObjectState& last, gpu::ObjectState& state,
                  gpu::uint& marks) {
  const float whole = budget.tau * budget.relaxed;
  state.tessellation =
      stepTowards(last.tessellation, pixelErrorTessellation(patchPixels, whole * view.hysteresis, view.maxTessellation),
                  pixelErrorTessellation(patchPixels, whole / view.hysteresis, view.maxTessellation));
  state.lod = last.lod;
  const gpu::uint left = std::min(fadeFrames(marks), view.fadeFrames + 1);
  if (seen && left > 1) {
    marks = (marks & gpu::kMarkFromCoarser) | (marks & ~gpu::kMarkFadeMask) | (left - 1) << gpu::kMarkFadeShift;
    return;
  }
  marks &= ~gpu::kMarkFadeMask;
  const std::uint32_t finest =
      relaxedLod(levels, pixelsPerUnit, budget.tau / view.hysteresis, budget.relaxed, budget.share);
  const std::uint32_t coarsest =
      std::max(finest, relaxedLod(levels, pixelsPerUnit, budget.tau * view.hysteresis, budget.relaxed, budget.share));
  state.lod = seen ? stepTowards(last.lod, finest, coarsest) : std::clamp(last.lod, finest, coarsest);
  if (seen && state.lod != last.lod && !has(view.traits, gpu::kTraitPatches) && view.fadeFrames > 0)
    marks |= (view.fadeFrames << gpu::kMarkFadeShift) | (last.lod > state.lod ? gpu::kMarkFromCoarser : 0);
}

}  // namespace

void chooseDetail(const gpu::CullView& view, std::span<const gpu::Lod> levels, float patchError,
                  const gpu::ScreenBox& box, bool seen, const gpu::ObjectState& last, gpu::ObjectState& state,
                  gpu::uint& marks) {
  const bool followsError = has(view.traits, gpu::kTraitFollowsError);
  const bool followsLv = has(view.traits, gpu::kTraitFollowsLv);
  const bool calm = followsError && (marks & gpu::kMarkRemembered) != 0;
  if (!calm) marks &= ~gpu::kMarkFadeMask;
  if (followsLv && !followsError) {
    state.lod = linearLod(state.lv, static_cast<std::uint32_t>(levels.size()));
    state.tessellation = tessellationLevel(state.lv, view.maxTessellation);
  } else if (followsError) {
    const float relaxed = followsLv ? relaxedBudget(state.lv, view.relax) : 1.0F;
    const float share = visibleShare(state.lv);
    const float patchPixels = patchError * box.pixelsPerUnit;
    if (calm) {
      followBudget(view, levels, patchPixels, box.pixelsPerUnit,
                   {box.tau, std::min(relaxed, gpu::kMostCalmRelaxed), std::max(share, gpu::kLeastCalmShare)}, seen,
                   last, state, marks);
    } else {
      state.lod = relaxedLod(levels, box.pixelsPerUnit, box.tau, relaxed, share);
      state.tessellation = pixelErrorTessellation(patchPixels, box.tau * relaxed, view.maxTessellation);
    }
  }
  const bool same =
      has(view.traits, gpu::kTraitPatches) ? state.tessellation == last.tessellation : state.lod == last.lod;
  if ((marks & gpu::kMarkKnown) != 0 && !same) marks |= gpu::kMarkSwitched;
}

}  // namespace jalousie::visibility
