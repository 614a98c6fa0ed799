// The linear mapping of the thesis and the projected error; plain CPU twin of shaders/lib/lod.glsl.
#include "visibility/lod_policy.h"

#include <algorithm>
#include <cmath>

#include "policy/traits.h"
#include "scene/scene_data.h"
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
  return (marks & gpu::kMarkFadeMask) >> gpu::kMarkFadeShift;
}

std::uint32_t fadingLod(std::uint32_t lod, gpu::uint marks) {
  return (marks & gpu::kMarkFromCoarser) != 0 ? lod + 1 : lod - 1;
}

std::uint32_t stepTowards(std::uint32_t last, std::uint32_t lowest, std::uint32_t highest) {
  return last < lowest ? last + 1 : last > highest ? last - 1 : last;
}

DetailInput detailInput(const scene::SceneData& scene, const gpu::Chain& chain, const gpu::ScreenBox& box, bool seen,
                        const gpu::ObjectState& last) {
  return {std::span(scene.lods).subspan(chain.firstLod, chain.lodCount),
          scene.lods[chain.patchLod].errorObject,
          box.pixelsPerUnit,
          box.tau,
          seen,
          last};
}

namespace {

/// Screen-space error that an object may have.
struct Budget {
  float tau;      ///< pixels, for a fully visible object
  float relaxed;  ///< factor for this one
  float share;    ///< visible share
};

/// Tessellation level that follows the budget within the hysteresis, one level at a time.
std::uint32_t calmTessellation(const gpu::CullView& view, const DetailInput& object, const Budget& budget) {
  const float patchPixels = object.patchError * object.pixelsPerUnit;
  const float whole = budget.tau * budget.relaxed;
  return stepTowards(object.last.tessellation,
                     pixelErrorTessellation(patchPixels, whole * view.hysteresis, view.maxTessellation),
                     pixelErrorTessellation(patchPixels, whole / view.hysteresis, view.maxTessellation));
}

/// Levels that follow the budget with hysteresis: the last level stays while it fits within the margin, else it changes
/// by one and is cross-faded. An object of which no pixel was visible switches at once to the nearest level that fits.
void followBudget(const gpu::CullView& view, const DetailInput& object, const Budget& budget, gpu::ObjectState& state,
                  gpu::uint& marks) {
  state.tessellation = calmTessellation(view, object, budget);
  state.lod = object.last.lod;
  const gpu::uint left = std::min(fadeFrames(marks), view.fadeFrames + 1);  // the fade may have begun with more frames
  if (object.seen && left > 1) {
    marks = (marks & gpu::kMarkFromCoarser) | (marks & ~gpu::kMarkFadeMask) | (left - 1) << gpu::kMarkFadeShift;
    return;
  }
  marks &= ~gpu::kMarkFadeMask;
  const std::uint32_t finest =
      relaxedLod(object.levels, object.pixelsPerUnit, budget.tau / view.hysteresis, budget.relaxed, budget.share);
  const std::uint32_t coarsest = std::max(
      finest,
      relaxedLod(object.levels, object.pixelsPerUnit, budget.tau * view.hysteresis, budget.relaxed, budget.share));
  state.lod =
      object.seen ? stepTowards(object.last.lod, finest, coarsest) : std::clamp(object.last.lod, finest, coarsest);
  if (object.seen && state.lod != object.last.lod && !has(view.traits, gpu::kTraitPatches) && view.fadeFrames > 0)
    marks |= (view.fadeFrames << gpu::kMarkFadeShift) | (object.last.lod > state.lod ? gpu::kMarkFromCoarser : 0);
}

}  // namespace

void chooseDetail(const gpu::CullView& view, const DetailInput& object, gpu::ObjectState& state, gpu::uint& marks) {
  const bool followsError = has(view.traits, gpu::kTraitFollowsError);
  const bool followsLv = has(view.traits, gpu::kTraitFollowsLv);
  const bool calm = followsError && (marks & gpu::kMarkRemembered) != 0;
  if (!calm) marks &= ~gpu::kMarkFadeMask;  // a fade that began in calm frames ends with them
  if (followsLv && !followsError) {
    state.lod = linearLod(state.lv, static_cast<std::uint32_t>(object.levels.size()));
    state.tessellation = tessellationLevel(state.lv, view.maxTessellation);
  } else if (followsError) {
    Budget budget{object.tau, followsLv ? relaxedBudget(state.lv, view.relax) : 1.0F, visibleShare(state.lv)};
    if (calm) {
      budget.relaxed = std::min(budget.relaxed, gpu::kMostCalmRelaxed);
      budget.share = std::max(budget.share, gpu::kLeastCalmShare);
      followBudget(view, object, budget, state, marks);
    } else {
      state.lod = relaxedLod(object.levels, object.pixelsPerUnit, budget.tau, budget.relaxed, budget.share);
      state.tessellation = pixelErrorTessellation(object.patchError * object.pixelsPerUnit, budget.tau * budget.relaxed,
                                                  view.maxTessellation);
    }
  }
  const bool same = has(view.traits, gpu::kTraitPatches) ? state.tessellation == object.last.tessellation
                                                         : state.lod == object.last.lod;
  if ((marks & gpu::kMarkKnown) != 0 && !same) marks |= gpu::kMarkSwitched;
}

}  // namespace jalousie::visibility
